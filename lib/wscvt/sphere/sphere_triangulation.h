// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Triangulation of the whole sphere whose vertices are unit vectors ("seeds"): 2 N - 4 triangles,
/// counter-clockwise seen from outside. Built from scratch by exact predicates, and kept as the
/// seeds move by flipping edges.
///
/// Half-edge 3 t + k runs from corner k of triangle t to corner (k + 1) % 3.
class SphereTriangulation {
 public:
  /// Regular triangulation (weighted Delaunay) of the seeds: the convex hull of p exp(w / 2).
  /// Without weights (empty) the Delaunay triangulation. Triangles are sorted, so the same seeds
  /// give the same arrays. Throws Error(NumericalFailure) when the seeds do not surround the
  /// origin, when two coincide, when a seed is hidden, that is, its weight is so low that it has no
  /// cell, or when a weight's absolute value is above 200 steradian or not a number; and
  /// Error(InvalidInput) for fewer than 4 seeds, another number of weights or a seed that is not
  /// finite; Error(Cancelled). The same on any number of threads, as everything here.
  explicit SphereTriangulation(const std::vector<Vector3>& seeds,
                               const std::vector<double>& weights = {},
                               const Execution& execution = Execution(1));

  /// The same, but nothing where the constructor would throw NumericalFailure: for callers who have
  /// other seeds to try.
  static std::optional<SphereTriangulation> try_build(const std::vector<Vector3>& seeds,
                                                      const std::vector<double>& weights = {},
                                                      const Execution& execution = Execution(1));

  /// Takes over given triangles. Throws Error(InvalidInput) unless they are 2 N - 4 triangles,
  /// counter-clockwise on the sphere, that form a closed 2-manifold on all N seeds;
  /// Error(Cancelled).
  SphereTriangulation(const std::vector<Vector3>& seeds, std::vector<Triangle> triangles,
                      const Execution& execution = Execution(1));

  std::size_t vertex_count() const { return first_half_edge_.size(); }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The half-edge that runs the other way, for each half-edge.
  const std::vector<std::int32_t>& opposite() const { return opposite_; }
  /// A half-edge that starts at each vertex.
  const std::vector<std::int32_t>& first_half_edge() const { return first_half_edge_; }

  static std::int32_t next(std::int32_t half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
  }
  static std::int32_t previous(std::int32_t half_edge) {
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
  }
  std::int32_t origin(std::int32_t half_edge) const {
    return triangles_[half_edge / 3][half_edge % 3];
  }

  /// What a repair by flips came to.
  struct Repair {
    int flips = 0;
    int stuck = 0;             ///< edges that ought to be flipped but cannot be
    bool turned_over = false;  ///< a triangle is clockwise on the sphere; nothing was flipped
    bool complete() const { return stuck == 0 && !turned_over; }
  };

  /// After the seeds moved or their weights changed: flips edges until every edge is regular
  /// (Lawson 1977). Exact predicates. When the repair is not complete the triangulation still is a
  /// closed 2-manifold on the same vertices, to be built anew by the caller.
  Repair restore_regular(const std::vector<Vector3>& seeds, const std::vector<double>& weights,
                         const Execution& execution);

  /// Flips edges until the two angles opposite to each edge sum to at most pi, measured on the
  /// surface mesh with vertices `positions` (Bobenko and Springborn 2007: intrinsic Delaunay), as
  /// long as the triangles stay counter-clockwise on the sphere of `seeds`; edges left for that
  /// reason are counted as stuck.
  Repair restore_surface_delaunay(const std::vector<Vector3>& seeds,
                                  const std::vector<Vector3>& positions,
                                  const Execution& execution);

  /// Whether the half-edge's edge may be flipped: both new triangles counter-clockwise on the
  /// sphere.
  bool is_flippable(std::int32_t half_edge, const std::vector<Vector3>& seeds) const;

  /// Replaces the edge by the other diagonal of its two triangles.
  void flip(std::int32_t half_edge);

 private:
  SphereTriangulation() = default;
  /// Triangulates; returns why that is not possible, or null.
  const char* build(const std::vector<Vector3>& seeds, const std::vector<double>& weights,
                    const Execution& execution);
  template <class NeedsFlip>
  Repair flip_while(const std::vector<Vector3>& seeds, const NeedsFlip& needs_flip,
                    const Execution& execution);
  void set_triangles(std::vector<Triangle> triangles, std::size_t vertices,
                     const Execution& execution);

  // Three parallel arrays instead of a half-edge structure: triangle t holds its corners, and its
  // half-edges 3 t to 3 t + 2 need no entry but the one that runs the other way.
  std::vector<Triangle> triangles_;            ///< corners of each triangle: indices of seeds
  std::vector<std::int32_t> opposite_;         ///< of each half-edge, three a triangle
  std::vector<std::int32_t> first_half_edge_;  ///< of each vertex: one that starts there, any
};

/// The unit sphere as a mesh: the points of subdivided_icosahedron(frequency), 10 frequency^2 + 2,
/// and their triangles. Throws as that.
IndexedMesh subdivided_sphere(int frequency);

}  // namespace wscvt
