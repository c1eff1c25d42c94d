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

/// The edge ab of the triangles abc (t) and bad (u), with its half-edges ab (h) and ba (g).
struct EdgeSides {
  std::int32_t h = -1, g = -1;
  std::int32_t t = -1, u = -1;
  std::int32_t a = -1, b = -1, c = -1, d = -1;
};

/// A closed, oriented 2-manifold for editing: edges are flipped, vertices merged and put on edges.
/// Every edit keeps it closed, oriented and of the same genus if the caller has checked `joined`
/// and the degrees as the edit requires. Half-edges are defined in half_edges.h.
struct EditMesh {
  std::vector<Vector3> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> opposite;  ///< of each half-edge
  std::vector<std::int32_t> first;     ///< a half-edge that starts at each vertex
  std::vector<std::int32_t> degrees;   ///< edges at each vertex

  EditMesh() = default;
  /// Links a closed, oriented 2-manifold in which every vertex has a triangle; this is not checked.
  EditMesh(std::vector<Vector3> mesh_points, std::vector<Triangle> mesh_triangles,
           const Execution& execution);

  /// Links the triangles anew.
  void link(const Execution& execution);

  std::int32_t origin(std::int32_t h) const { return origin_of(triangles, h); }
  std::int32_t target(std::int32_t h) const { return target_of(triangles, h); }
  /// Returns the corner of the half-edge's triangle opposite to it.
  std::int32_t apex(std::int32_t h) const { return origin(previous_half_edge(h)); }

  /// Returns the two sides of a half-edge's edge.
  EdgeSides sides(std::int32_t h) const {
    const std::int32_t g = opposite[h];
    const auto t = static_cast<std::int32_t>(face_of(h));
    const auto u = static_cast<std::int32_t>(face_of(g));
    return {h, g, t, u, origin(h), origin(g), apex(h), apex(g)};
  }

  /// Returns the outward normal of a triangle, with the length of twice its area.
  Vector3 normal(std::size_t t) const { return doubled_area_normal(*this, t); }
  /// Returns the cosine of a triangle's smallest angle.
  double sharpness(std::size_t t) const {
    const auto& [a, b, c] = triangles[t];
    return largest_corner_cosine(points[a], points[b], points[c]);
  }

  /// Calls visit(h) for the half-edges that start at a vertex, counter-clockwise.
  template <class Visit>
  void around(std::int32_t v, const Visit& visit) const {
    visit_outgoing(opposite, first[index(v)], visit);
  }

  /// Returns whether an edge joins two vertices.
  bool joined(std::int32_t a, std::int32_t b) const;

  /// Replaces an edge by the other diagonal of its two triangles (flip_edge of half_edges.h). The
  /// ends of the new edge must be two vertices that are not joined yet; the ends of the old edge
  /// need a degree above 3.
  void flip(std::int32_t h);

  /// Merges the origin of a half-edge into its target, which does not move. The two must have
  /// exactly two common neighbours, each of a degree above 3. Returns the two triangles that are
  /// now free; the origin has no triangle any more.
  std::array<std::int32_t, 2> collapse(std::int32_t h);

  /// Puts a vertex without triangles on an edge. Its two triangles become four; the new two use the
  /// `free` indices.
  void put_on_edge(std::int32_t v, std::int32_t h, const std::array<std::int32_t, 2>& free);

 private:
  void pair(std::int32_t h, std::int32_t g) {
    opposite[index(h)] = g;
    opposite[index(g)] = h;
  }
};

/// Returns the mean length of the edges; there must be at least one.
double mean_edge_length(const EditMesh& mesh);

/// Returns the mean over the triangles of longest / shortest edge.
double mean_edge_ratio(const EditMesh& mesh);

/// Flips edges towards the Delaunay triangulation of a surface, once over all of them. No face
/// turns against its surface. Sharp edges, as at rims, are flipped if the faces then turn less: the
/// sum of 1 - cos over the edge and the four about it falls, as in the criterion of the angle
/// between normals of Dyn, Levin, Rippa 1990 (IMA J. Numer. Anal. 10, 137).
/// `outward` has a vector per vertex that points out of the surface, with the length of its area,
/// or all with one length. Returns the number of flips.
int flip_to_delaunay(EditMesh& mesh, const std::vector<Vector3>& outward);

/// Returns the cosine of the angle between a face's unit normal and the surface's direction; 1 if
/// the direction is zero.
inline double cosine_to(const Vector3& unit_normal, const Vector3& direction) {
  const double length = direction.norm();
  return length > 1e-300 ? unit_normal.dot(direction) / length : 1.0;
}

/// Smallest cosine to its surface's direction at which a face has not turned against it: 78
/// degrees.
inline constexpr double least_agreement = 0.2;

}  // namespace wscvt
