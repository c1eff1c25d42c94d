// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A place on a triangle mesh: a triangle and barycentric weights >= 0 of its corners, sum 1.
struct MeshPlace {
  std::int32_t triangle = -1;
  Vector3 weights = Vector3::Zero();
};

/// Returns the point of a mesh at a place.
inline Vector3 point_at(const IndexedMesh& mesh, const MeshPlace& place) {
  // Starts from a corner, so that only small differences are multiplied if the mesh is far from the
  // origin.
  const auto& [a, b, c] = mesh.triangles[place.triangle];
  const Vector3& p = mesh.points[a];
  return p + place.weights[1] * (mesh.points[b] - p) + place.weights[2] * (mesh.points[c] - p);
}

}  // namespace wscvt
