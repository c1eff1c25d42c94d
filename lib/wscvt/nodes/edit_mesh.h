// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

/// A closed, oriented 2-manifold that is edited: its edges are flipped, its vertices merged and
/// put on edges. Every edit keeps it closed, oriented and of the same genus where the caller has
/// asked `joined` and counted degrees as the edit says. Half-edges are those of half_edges.h.
struct EditMesh {
  std::vector<Vector3> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> opposite;  ///< of each half-edge
  std::vector<std::int32_t> first;     ///< a half-edge that starts at each vertex
  std::vector<std::int32_t> degrees;   ///< edges at each vertex

  EditMesh() = default;
  /// Links a closed, oriented 2-manifold whose vertices all have triangles, which is not checked.
  EditMesh(std::vector<Vector3> mesh_points, std::vector<Triangle> mesh_triangles,
           const Execution& execution);

  /// Links the triangles anew.
  void link(const Execution& execution);

  std::int32_t origin(std::int32_t h) const { return origin_of(triangles, h); }
  std::int32_t target(std::int32_t h) const { return target_of(triangles, h); }
  /// The corner of the half-edge's triangle that lies opposite to it.
  std::int32_t apex(std::int32_t h) const { return origin(previous_half_edge(h)); }

  /// The normal of a triangle, outward, as long as twice its area.
  Vector3 normal(std::size_t t) const {
    const auto& [a, b, c] = triangles[t];
    return doubled_area_normal(points[a], points[b], points[c]);
  }
  /// Cosine of a triangle's smallest angle.
  double sharpness(std::size_t t) const {
    const auto& [a, b, c] = triangles[t];
    return largest_corner_cosine(points[a], points[b], points[c]);
  }

  /// Calls visit(h) for the half-edges that start at a vertex, counter-clockwise.
  template <class Visit>
  void around(std::int32_t v, const Visit& visit) const {
    visit_outgoing(opposite, first[index(v)], visit);
  }

  /// Whether an edge joins two vertices.
  bool joined(std::int32_t a, std::int32_t b) const;

  /// Replaces an edge by the other diagonal of its two triangles (flip_edge of half_edges.h). The
  /// ends of the new edge must not be joined yet, nor one vertex; those of the old one need a
  /// degree above 3.
  void flip(std::int32_t h);

  /// Merges the vertex that a half-edge starts at into the one that it ends at, whose place it does
  /// not change. The two must have two common neighbours only, each of a degree above 3. Returns
  /// the two triangles that are free now; the vertex has no triangle any more.
  std::array<std::int32_t, 2> collapse(std::int32_t h);

  /// Puts a vertex without triangles on an edge, whose two triangles become four, the other two in
  /// the `free` places.
  void put_on_edge(std::int32_t v, std::int32_t h, const std::array<std::int32_t, 2>& free);

 private:
  void pair(std::int32_t h, std::int32_t g) {
    opposite[index(h)] = g;
    opposite[index(g)] = h;
  }
};

/// Mean length of the edges; they are at least one.
double mean_edge_length(const EditMesh& mesh);

/// Mean over the triangles of the ratio of the longest to the shortest edge.
double mean_edge_ratio(const EditMesh& mesh);

}  // namespace wscvt
