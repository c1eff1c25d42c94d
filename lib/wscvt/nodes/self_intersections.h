// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Two triangles of a mesh, the smaller index first.
using TrianglePair = std::pair<std::int32_t, std::int32_t>;

/// The pairs of triangles that meet elsewhere than in the corners and edges they share, in
/// ascending order. Exact: bounding boxes sort out the candidates and exact predicates decide
/// (CGAL's Polygon_mesh_processing), so that none is missed and none invented. Triangles without
/// area count as pairs with themselves. The mesh must be a closed, oriented 2-manifold; throws
/// Error(InvalidInput) otherwise.
std::vector<TrianglePair> self_intersections(const IndexedMesh& mesh);

/// Whether two triangles of a mesh, named by their corners, meet elsewhere than in what they share:
/// nothing, a corner or an edge. Exact. Triangles of the same three corners do not count, nor do
/// two that lie on each other from an edge on, which no place but the edge's turn tells from two
/// that go on.
bool triangles_meet(const std::vector<Vector3>& points, const Triangle& a, const Triangle& b);

/// The vertices of those triangles, in ascending order, each once.
std::vector<std::int32_t> vertices_of(const std::vector<TrianglePair>& pairs,
                                      const std::vector<Triangle>& triangles);

}  // namespace wscvt
