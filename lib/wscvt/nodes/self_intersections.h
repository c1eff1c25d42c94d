// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Two triangles of a mesh, the smaller index first.
using TrianglePair = std::pair<std::int32_t, std::int32_t>;

/// The pairs of triangles that meet elsewhere than in the corners and edges they share, in
/// ascending order. Exact: bounding boxes sort out the candidates and exact predicates decide, so
/// that none is missed and none invented. Triangles without area count as pairs with themselves,
/// and with no other. The same on any number of threads. Throws Error(Cancelled).
std::vector<TrianglePair> self_intersections(const IndexedMesh& mesh,
                                             const Execution& execution = Execution(1));

/// Whether two triangles of a mesh, named by their corners, meet elsewhere than in what they share:
/// nothing, a corner or an edge. Those of the same three corners do. Exact; both have an area.
bool triangles_meet(const std::vector<Vector3>& points, const Triangle& a, const Triangle& b);

/// The vertices of those triangles, in ascending order, each once.
std::vector<std::int32_t> vertices_of(const std::vector<TrianglePair>& pairs,
                                      const std::vector<Triangle>& triangles);

}  // namespace wscvt
