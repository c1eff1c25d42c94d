// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/mesh_quality.h"

namespace wscvt {

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

}  // namespace wscvt
