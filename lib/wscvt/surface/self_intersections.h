// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {

/// Two triangles of a mesh, the smaller index first.
using TrianglePair = std::pair<std::int32_t, std::int32_t>;

/// Returns the pairs of triangles that intersect outside their shared corners and edges, in
/// ascending order. Exact: bounding boxes find the candidates and exact predicates decide.
/// Triangles without area count as pairs with themselves and with no other. The result does not
/// depend on the number of threads. Throws Error(Cancelled).
std::vector<TrianglePair> self_intersections(const IndexedMesh& mesh,
                                             const Execution& execution = Execution(1));

/// Returns those of the pairs that have a triangle in `asked`, numbers of triangles: takes time for
/// these triangles and a glance at each other one. Throws Error(Cancelled).
std::vector<TrianglePair> self_intersections_of(const std::vector<std::int32_t>& asked,
                                                const IndexedMesh& mesh,
                                                const Execution& execution = Execution(1));

/// Returns whether two triangles of a mesh, given by their corners, intersect outside their shared
/// corners and edges. Two triangles with the same three corners do. Exact; both must have an area.
bool triangles_meet(const std::vector<Vector3>& points, const Triangle& a, const Triangle& b);

/// Returns the vertices of the pairs' triangles, in ascending order, each once.
std::vector<std::int32_t> vertices_of(const std::vector<TrianglePair>& pairs,
                                      const std::vector<Triangle>& triangles);

/// Pairs of triangles of a mesh that intersect, counted in bounded time.
struct CrossingPairs {
  std::size_t count = 0;  ///< of triangles with an area
  /// Whether all triangles were looked at. Else 500, spread over the mesh, were looked at, each
  /// against all others.
  bool is_all = true;
};

/// Counts the pairs of triangles that intersect outside their shared corners and edges. A mesh of
/// up to 500 triangles is looked at as a whole. Throws Error(Cancelled).
CrossingPairs crossing_pairs(const IndexedMesh& mesh, const Execution& execution = Execution(1));

/// Returns a sentence on the pairs of `whose` mesh, such as "the scan"; empty without pairs.
std::string crossing_sentence(const CrossingPairs& pairs, const std::string& whose);

/// Counts of part_triangles.
struct PartingReport {
  std::size_t before = 0;  ///< intersecting triangle pairs
  std::size_t after = 0;   ///< pairs that remain
};

/// Separates intersecting triangles. The nodes of a knot move outwards, for chords of both sheets
/// of a thin place, or towards the middles of their rings, for folded neighbours; the move that
/// leaves fewer pairs is used. Other nodes stay. The number of pairs never grows.
PartingReport part_triangles(EditMesh& mesh, const Execution& execution);

}  // namespace wscvt
