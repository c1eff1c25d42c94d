// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/repair/scan_options.h"

namespace wscvt {

/// The scan as both methods use it: one closed, outward surface, in the input's units.
struct RepairedScan {
  CheckedMesh checked;
  double steep_area_fraction = 0.0;  ///< of a surface made of points, see RemeshResult; else 0
  std::string precision_warning;     ///< see precision_warning
  std::string crossing_warning;      ///< on triangles that intersect; empty without
};

/// Makes a surface of points and shrink-wraps the scan, if asked for, and repairs it (see
/// check_mesh). Throws Error as mesh_of_points, shrink_wrap_of and check_mesh do.
RepairedScan repair_scan(IndexedMesh scan, const RemeshOptions& options,
                         const Execution& execution);

}  // namespace wscvt
