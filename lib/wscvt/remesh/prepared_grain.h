// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "wscvt/base/execution.h"
#include "wscvt/measures/distances.h"
#include "wscvt/remesh/remesh_method.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/remesh_result.h"
#include "wscvt/remesh/repaired_scan.h"
#include "wscvt/repair/scan_options.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// A grain prepared for remeshing to any number of nodes by one of the methods, which refers to it,
/// so it is not moved.
struct PreparedGrain {
  PreparedGrain() = default;
  PreparedGrain(const PreparedGrain&) = delete;
  PreparedGrain& operator=(const PreparedGrain&) = delete;

  NormalizedScan scan;
  MeshCheckReport input;  ///< in the input's units
  HandleReport handles;   ///< in the input's units; as published none is cut
  SeriesCoefficients coefficients;
  double steep_area_fraction = 0.0;  ///< see RemeshResult
  std::unique_ptr<const RemeshMethod> method;
  /// From points to the scan. On a dense scan, building this tree costs more than querying it. All
  /// node counts of a search share one tree.
  std::optional<MeshDistance> distance;
};

/// Prepares a repaired scan for the method in the options. This is where the method is chosen.
/// Throws Error as the methods do.
void prepare(CheckedMesh checked, const RemeshOptions& options, const Execution& execution,
             PreparedGrain& grain);

/// Prepares a surface given by a formula or by coefficients. `scaled`, of equivalent radius 1, must
/// outlive the grain; `integrals` are the surface's, in the unit `unit`.
void prepare(const RadialSurface& scaled, const SurfaceIntegrals& integrals, double unit,
             const RemeshOptions& options, const Execution& execution, PreparedGrain& grain);

/// Places and measures `node_count` nodes; no search, no warnings. Throws Error as the method does.
RemeshResult remesh_prepared(const PreparedGrain& grain, const RemeshOptions& options,
                             int node_count, const Execution& execution);

/// Returns whether the smallest number of nodes is searched for.
inline bool searches(const RemeshOptions& options) { return options.target.percent > 0.0; }

}  // namespace wscvt
