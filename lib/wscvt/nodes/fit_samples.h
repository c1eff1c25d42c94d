// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/edit_mesh.h"
#include "wscvt/nodes/triangle_place.h"

namespace wscvt {

/// A point of the scan that a mesh is fitted to, and where on that mesh its nearest point lies.
struct FitSample {
  Vector3 point;
  Vector3 normal;         ///< the scan's there, outward, unit
  double spacing = 1.0;   ///< wanted distance of nodes there, in that of even nodes
  std::int32_t face = 0;  ///< the triangle with the nearest point
  TrianglePlace place;    ///< of that point
};

/// A scan to draw samples of.
struct SampledScan {
  IndexedMesh mesh;
  std::vector<Vector3> normals;  ///< at the vertices, outward, unit
};

/// `count` points spread evenly by area over the scan, one in each of equal shares of it, in the
/// order of its faces. Normals are those of the vertices, interpolated, which smooths the noise of
/// a scan; where a face is as large as the cell of a node it is no noise, and the normal its own:
/// `cell` is the area a node. The sample's `face` is the vertex of the scan that is nearest in the
/// face, for the caller to place. The same points for the same scan.
std::vector<FitSample> draw_fit_samples(const SampledScan& scan, std::size_t count, double cell);

}  // namespace wscvt
