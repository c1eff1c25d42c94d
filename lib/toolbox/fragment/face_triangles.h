// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "toolbox/convex/face_cut.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns a number that only the edge between two points has, in either direction.
inline std::uint64_t undirected_key(std::int32_t a, std::int32_t b) {
  return a < b ? edge_key(a, b) : edge_key(b, a);
}

/// Divides a planar face, an outer loop and its holes, into triangles of its own points, turned as
/// the face. Each edge of the face belongs to one triangle and each other edge to two, also if
/// rounding makes the loops cross. Cuts off the corner with the best triangle first. `taken` are
/// the edges of all faces (see undirected_key). New edges are none of them and are added, so that
/// two faces of a body never share one.
std::vector<Triangle> face_triangles(const std::vector<Vector3>& points, const FaceEdges& edges,
                                     const Vector3& normal,
                                     std::unordered_set<std::uint64_t>& taken);

}  // namespace wscvt
