// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/remesh_result.h"
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

/// A closed, outward mesh of equivalent radius 1 about the origin, so that tolerances mean the same
/// for every scan. All lengths but `unit` and `centre` are in `unit`.
struct NormalizedScan {
  IndexedMesh mesh;
  double unit = 1.0;                 ///< the scan's equivalent radius, in the input's length
  Vector3 centre = Vector3::Zero();  ///< of the scan, in the input's coordinates
  ShapeDescriptors shape;
  MeshQuality quality;
};

/// Moves the volume centroid `centre` to the origin, scales by 1 / `unit` and measures the shape.
/// Throws Error(Cancelled).
NormalizedScan normalize(IndexedMesh mesh, const Vector3& centre, double unit,
                         const Execution& execution);

/// Converts results in units of `unit` about `centre` to the input's units and coordinates.
void to_input_units(double unit, const Vector3& centre, RemeshResult& result);

}  // namespace wscvt
