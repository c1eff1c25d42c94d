// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/refinement_facet.h"
#include "wscvt/nodes/refinement_samples.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/mesh_surface.h"

namespace wscvt {

/// Triangles about a node, or half-edges, are handled by the hundred in one task of the threads.
inline constexpr std::size_t refinement_block = 32;

/// A mesh that is being refined, and the samples of the original that it is held against. The
/// arrays of one index stay in step: whoever changes a triangle gives it its samples and its error,
/// whoever moves a node its node error.
struct RefinementState {
  const MeshSurface& original;
  std::vector<Vector3> samples;  ///< of the original, see visible_samples
  double node_weight = 0.0;      ///< what a node's own distance counts, in samples
  double cosine_limit = 1.0;     ///< of the smallest angle allowed

  std::vector<Vector3> positions;  ///< per node, about the origin
  SphereTriangulation triangulation;
  std::vector<SampleList> lists;    ///< per triangle: its samples, seen from the origin
  std::vector<double> errors;       ///< per triangle: sum of the penalties of its samples
  std::vector<double> node_errors;  ///< per node: penalty of its own distance, weighed
  double outlier_weight = 0.0;      ///< of the fourth power in the penalty; 1 / length^2

  /// The mesh with its samples dealt out; errors are 0 until measured.
  RefinementState(std::vector<Vector3> nodes, SphereTriangulation of_nodes, const MeshSurface& scan,
                  double smallest_angle, const Execution& execution);

  /// What the moves, flips and relocations lower.
  double error() const;

  /// Computes all errors, with distances weighed from here on by their rms now, and returns that.
  double measure(const Execution& execution);

  RefinementFacet facet(std::int32_t triangle) const {
    return facet(triangulation.triangles()[triangle]);
  }
  RefinementFacet facet(const Triangle& t) const {
    return {positions[t[0]], positions[t[1]], positions[t[2]]};
  }
  /// What a sample's distance counts.
  double penalty(double residual) const {
    const double square = residual * residual;
    return square + outlier_weight * square * square;
  }
  /// Half the penalty's derivative / residual: what a sample weighs in a Gauss-Newton step.
  double penalty_weight(double residual) const {
    return 1.0 + 2.0 * outlier_weight * residual * residual;
  }
  double error_of(const RefinementFacet& facet, const SampleList& list) const {
    double sum = 0.0;
    for (const std::int32_t s : list) sum += penalty(facet.residual(samples[s]));
    return sum;
  }
  /// How far a place is from the original's tangent plane above or below it (> 0: above the place),
  /// and that plane's normal; length.
  double node_residual(const Vector3& position, Vector3& normal) const;
  double node_error(const Vector3& position) const;

  /// The corner of a half-edge's triangle that is not on it; the triangle lies to its left.
  std::int32_t corner_left_of(std::int32_t half_edge) const {
    return triangulation.origin(SphereTriangulation::previous(half_edge));
  }
  /// The neighbours of a node, counter-clockwise from outside, and, unless null, the triangles
  /// about it: triangles[j] holds the node, ring[j] and ring[j + 1].
  void ring_of(std::int32_t node, std::vector<std::int32_t>& ring,
               std::vector<std::int32_t>* triangles) const;
};

}  // namespace wscvt
