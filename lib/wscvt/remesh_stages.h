// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/report/remesh_options.h"
#include "wscvt/report/remesh_result.h"
#include "wscvt/scan/scan_options.h"
#include "wscvt/surface/grain.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// All that does not depend on the number of nodes, in the grain's units unless told otherwise.
struct PreparedGrain {
  Grain grain;
  IndexedMesh used_scan;  ///< see RemeshResult; in the input's units
  MeshCheckReport input;  ///< in the input's units
  HandleReport handles;   ///< in the input's units
  ShapeDescriptors original;
  MeshQuality original_quality;
  /// To the grain's mesh, where distances are measured or only a level of the scan is mapped. It
  /// takes longer to make ready than to ask on a dense scan, so it is made once for all node counts
  /// that are tried.
  std::optional<MeshDistance> distance;
  std::string precision_warning;  ///< see precision_warning
};

/// Checks, mends, centres and maps a scan. Throws as remesh does.
PreparedGrain prepare(IndexedMesh scan, const RemeshOptions& options, const Execution& execution);

/// The same of a surface given by a formula, which must outlive the result.
PreparedGrain prepare(const RadialSurface& surface, const RemeshOptions& options,
                      const Execution& execution);

/// Reads the curvatures that the options' weighting asks for, in place of those that another read:
/// makes a prepared grain ready for options that differ by their weighting alone. Throws as remesh
/// does.
void read_curvatures(PreparedGrain& prepared, const RemeshOptions& options,
                     const Execution& execution);

/// Relaxes, places and measures `options.node_count` nodes; no error target, no warnings. Throws as
/// remesh does.
RemeshResult remesh_prepared(const PreparedGrain& prepared, const RemeshOptions& options,
                             const Execution& execution);

}  // namespace wscvt
