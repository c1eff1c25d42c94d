// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/refinement_facet.h"
#include "wscvt/nodes/refinement_samples.h"
#include "wscvt/nodes/refinement_target.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

/// Triangles about a node, or half-edges, are handled by the hundred in one task of the threads.
inline constexpr std::size_t refinement_block = 32;

/// A mesh that is being refined, and the samples of the original that it is held against. The
/// arrays of one index stay in step: whoever changes a triangle gives it its samples and its error,
/// whoever moves a node its node error.
struct RefinementState {
  const RefinementTarget& original;
  RefinementSamples samples;   ///< of the original
  double node_weight = 0.0;    ///< what a node's own distance counts, in samples
  double cosine_limit = 1.0;   ///< of the smallest angle allowed
  AnglePenalty angle_penalty;  ///< weighed by measure()

  std::vector<RefinementNode> nodes;
  SphereTriangulation triangulation;
  std::vector<SampleList> lists;    ///< per triangle: the samples in its directions
  std::vector<double> errors;       ///< per triangle: penalties of its samples and its angles
  std::vector<double> node_errors;  ///< per node: penalty of its own distance, weighed
  double outlier_weight = 0.0;      ///< of the fourth power in the penalty; 1 / length^2

  /// The mesh with its samples dealt out; errors are 0 until measured.
  RefinementState(std::vector<RefinementNode> start, SphereTriangulation of_nodes,
                  const RefinementTarget& scan, double smallest_angle, const Execution& execution);

  /// What the moves, flips and relocations lower.
  double error() const;

  /// Computes all errors, with distances weighed from here on by their rms now, and returns that.
  /// A triangle with an angle of 0 counts `angle_strength` times the mean triangle's sum of
  /// squares.
  double measure(const Execution& execution, double angle_strength = 0.0);

  RefinementFacet facet(std::int32_t triangle) const {
    return facet(triangulation.triangles()[triangle]);
  }
  RefinementFacet facet(const Triangle& t) const { return {nodes[t[0]], nodes[t[1]], nodes[t[2]]}; }
  /// How many triangles have an angle of a larger cosine.
  int count_sharper(double cosine) const;
  /// The normal of a triangle's facet, without its angles.
  Vector3 normal(std::int32_t triangle) const;
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
    double sum = angle_penalty(facet);
    for (const std::int32_t s : list) sum += penalty(facet.residual(samples.points[s]));
    return sum;
  }
  double node_error(const RefinementNode& node) const;

  /// Whether the edges of some triangles may turn by as much as they would: the angle between the
  /// normals at an edge, whose cosine is `after` at the one that turns most, and was `before`. They
  /// may where it was no less before, or is no more than 60 degrees, or than the scan's own surface
  /// turns among the triangles' samples, `own`, and those of the triangles `beside`, but never by
  /// more than 120. So the nodes follow ridges as sharp as the scan's, and no triangle is drawn out
  /// into a fin.
  bool may_turn(double after, double before, const std::vector<SampleList>& own,
                const std::vector<std::int32_t>& beside) const;
  /// The same for triangles whose samples are those of triangles as they are.
  bool may_turn(double after, double before, const std::vector<std::int32_t>& own,
                const std::vector<std::int32_t>& beside) const;

  /// The corner of a half-edge's triangle that is not on it; the triangle lies to its left.
  std::int32_t corner_left_of(std::int32_t half_edge) const {
    return triangulation.origin(SphereTriangulation::previous(half_edge));
  }
  /// The neighbours of a node, counter-clockwise from outside, and, unless null, the triangles
  /// about it: triangles[j] holds the node, ring[j] and ring[j + 1].
  void ring_of(std::int32_t node, std::vector<std::int32_t>& ring,
               std::vector<std::int32_t>* triangles) const;
  /// The half-edges across the outer edges of the triangles about a node: outer[j] runs from
  /// ring[j + 1] to ring[j].
  void outer_half_edges_of(std::int32_t node, std::vector<std::int32_t>& outer) const;
};

}  // namespace wscvt
