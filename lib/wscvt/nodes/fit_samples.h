// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/edit_mesh.h"
#include "wscvt/surface/triangle_place.h"

namespace wscvt {

/// A point of the scan to which a mesh is fitted, and its nearest point on the mesh.
struct FitSample {
  Vector3 point;
  Vector3 normal;         ///< the scan's, outward, unit
  double spacing = 1.0;   ///< wanted distance of nodes here / distance of even nodes
  std::int32_t face = 0;  ///< the triangle with the nearest point
  TrianglePlace place;    ///< of that point
};

/// A scan from which samples are drawn.
struct SampledScan {
  IndexedMesh mesh;
  std::vector<Vector3> normals;  ///< at the vertices, outward, unit
};

/// Returns `count` points of the scan, evenly distributed: one in each of `count` equal areas, in
/// the order of its faces. Normals are interpolated between the vertices, which smooths the noise
/// of a scan. If a face is as large as the cell of a node, its own normal is used instead; `cell`
/// is the area per node. The sample's `face` is the nearest vertex of its face; the caller replaces
/// it. Deterministic.
std::vector<FitSample> draw_fit_samples(const SampledScan& scan, std::size_t count, double cell);

}  // namespace wscvt
