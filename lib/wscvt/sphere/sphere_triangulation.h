// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A triangulation of the whole sphere whose vertices are unit vectors ("seeds"): 2 N - 4
/// triangles, counter-clockwise seen from outside. It is built by exact predicates. When the seeds
/// move, edge flips update it. Half-edges are defined in half_edges.h.
class SphereTriangulation {
 public:
  /// Builds the regular triangulation (weighted Delaunay) of the seeds: the convex hull of p exp(w
  /// / 2). Without weights it is the Delaunay triangulation. Triangles are sorted, so equal seeds
  /// give equal arrays, on any number of threads. Throws Error(NumericalFailure) if the seeds do
  /// not surround the origin, two seeds coincide, a seed is hidden (its weight is so low that it
  /// has no cell), or a weight's absolute value is above 200 steradian or NaN. Throws
  /// Error(InvalidInput) for fewer than 4 seeds, a wrong number of weights or a seed that is not
  /// finite; Error(Cancelled).
  explicit SphereTriangulation(const std::vector<Vector3>& seeds,
                               const std::vector<double>& weights = {},
                               const Execution& execution = Execution(1));

  /// Builds as the constructor, but returns nothing where it would throw NumericalFailure: for
  /// callers that can try other seeds.
  static std::optional<SphereTriangulation> try_build(const std::vector<Vector3>& seeds,
                                                      const std::vector<double>& weights = {},
                                                      const Execution& execution = Execution(1));

  /// Uses the given triangles. Throws Error(InvalidInput) unless they are 2 N - 4 triangles,
  /// counter-clockwise on the sphere, that form a closed 2-manifold on all N seeds;
  /// Error(Cancelled).
  SphereTriangulation(const std::vector<Vector3>& seeds, std::vector<Triangle> triangles,
                      const Execution& execution = Execution(1));

  std::size_t vertex_count() const { return first_half_edge_.size(); }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The opposite half-edge of each half-edge.
  const std::vector<std::int32_t>& opposite() const { return opposite_; }
  /// A half-edge that starts at each vertex.
  const std::vector<std::int32_t>& first_half_edge() const { return first_half_edge_; }

  std::int32_t origin(std::int32_t half_edge) const { return origin_of(triangles_, half_edge); }
  /// The corner of the half-edge's triangle opposite to it.
  std::int32_t apex(std::int32_t half_edge) const { return origin(previous_half_edge(half_edge)); }

  /// The result of a repair by flips.
  struct Repair {
    int flips = 0;
    /// False if an edge ought to be flipped but cannot be, or if a triangle was clockwise on the
    /// sphere; then nothing was flipped.
    bool complete = true;
  };

  /// Flips edges until every edge is regular (Lawson 1977), after the seeds or their weights have
  /// changed. Uses exact predicates. If the repair is not complete, the triangulation is still a
  /// closed 2-manifold on the same vertices, but the caller must build a new one.
  Repair restore_regular(const std::vector<Vector3>& seeds, const std::vector<double>& weights,
                         const Execution& execution);

  /// Flips edges until the two angles opposite to each edge sum to at most pi, measured on the
  /// surface mesh with vertices `positions` (Bobenko and Springborn 2007: intrinsic Delaunay). Does
  /// not flip an edge if a triangle would not stay counter-clockwise on the sphere of `seeds`.
  Repair restore_surface_delaunay(const std::vector<Vector3>& seeds,
                                  const std::vector<Vector3>& positions,
                                  const Execution& execution);

 private:
  SphereTriangulation() = default;
  /// Triangulates. Returns null or the reason of a failure.
  const char* build(const std::vector<Vector3>& seeds, const std::vector<double>& weights,
                    const Execution& execution);
  /// Whether the half-edge's edge may be flipped: both new triangles must be counter-clockwise on
  /// the sphere.
  bool is_flippable(std::int32_t half_edge, const std::vector<Vector3>& seeds) const;
  template <class NeedsFlip>
  Repair flip_while(const std::vector<Vector3>& seeds, const NeedsFlip& needs_flip,
                    const Execution& execution);
  void set_triangles(std::vector<Triangle> triangles, std::size_t vertices,
                     const Execution& execution);

  // Three arrays instead of a half-edge structure: triangle t stores its corners, and its
  // half-edges 3 t to 3 t + 2 store only their opposites.
  std::vector<Triangle> triangles_;            ///< corners of each triangle: indices of seeds
  std::vector<std::int32_t> opposite_;         ///< of each half-edge, three per triangle
  std::vector<std::int32_t> first_half_edge_;  ///< of each vertex: one that starts there, any
};

/// Returns the unit sphere as a mesh: the 10 frequency^2 + 2 points of
/// subdivided_icosahedron(frequency) and their triangles. Throws as subdivided_icosahedron.
IndexedMesh subdivided_sphere(int frequency);

/// Returns the triangles of CGAL's Delaunay triangulation of finite unit vectors on the sphere, in
/// no order. Empty if they do not cover the sphere, or if CGAL merges a seed with a neighbour. Uses
/// the one thread that `execution` reports from; a million seeds take seconds.
std::vector<Triangle> sphere_delaunay(const std::vector<Vector3>& seeds,
                                      const Execution& execution);

/// Returns the exact sign of det(b - a, c - a, d - a): positive if d lies on the side of the plane
/// abc from which abc is counter-clockwise.
///
/// The sign must be exact, because algorithms build on it. Edge flips end only if all signs are
/// consistent. With rounding, both diagonals of four points nearly on one circle may look wrong and
/// are flipped for ever. If a triangle without area passes for a good one, its surroundings turn
/// inside out, and a walk among triangles circles it. CGAL's predicate usually decides by
/// floating-point arithmetic with an error bound, and computes exactly only if that fails.
int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Returns the exact sign of det(a, b, c): positive if the directions a, b, c are counter-clockwise
/// seen from outside the sphere. Their lengths do not matter.
inline int sphere_orientation(const Vector3& a, const Vector3& b, const Vector3& c) {
  return orientation(Vector3::Zero(), a, b, c);
}

/// Whether abc is counter-clockwise seen from outside the sphere, exactly: det(a, b, c) > 0.
inline bool counter_clockwise(const Vector3& a, const Vector3& b, const Vector3& c) {
  return sphere_orientation(a, b, c) > 0;
}

}  // namespace wscvt
