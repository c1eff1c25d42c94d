// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_angles.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <utility>

#include "wscvt/nodes/refinement_fan.h"
#include "wscvt/nodes/refinement_flips.h"
#include "wscvt/nodes/refinement_moves.h"

namespace wscvt {

namespace {

/// Smallest change of a cosine that counts as a mended angle: far above rounding, so that two
/// states cannot take each other's place for ever, and 2e-4 degrees at 15 degrees.
constexpr double smallest_mending = 1e-6;

/// The step that takes a node's angles to the limit if they followed it in proportion, the shortest
/// there is.
Vector3 step_of_angles(const RefinementState& state, const RefinementFan& fan) {
  Matrix3 matrix = Matrix3::Zero();
  Vector3 gradient = Vector3::Zero();
  add_angles(state, fan, {state.cosine_limit, 1.0}, matrix, gradient);
  matrix.diagonal().array() += 1e-6 * matrix.trace() + std::numeric_limits<double>::min();
  return matrix.ldlt().solve(gradient);
}

/// Takes a node with a smaller angle about it than allowed to where its angles are better, or else
/// towards the middle of its neighbours.
bool mend_node(RefinementState& state, std::int32_t node, FanWorkspace& work) {
  FanLimits limits = load_fan(state, node, work);
  if (limits.largest_cosine <= state.cosine_limit) return false;
  Vector3 middle = Vector3::Zero();
  for (const std::int32_t other : work.fan.ring) middle += state.nodes[other].position;
  middle /= static_cast<double>(work.fan.ring.size());
  // A step that does not reach the limit is taken too, if only it comes nearer.
  limits.largest_cosine = std::max(state.cosine_limit, limits.largest_cosine - smallest_mending);
  const Vector3 start = work.fan.node.position;
  const Vector3 step = step_of_angles(state, work.fan);
  const Vector3 way = middle - start;
  // Shorter steps before longer ones: every step costs distance to the original.
  for (const Vector3& shift : {Vector3(0.5 * step), step, Vector3(1.5 * step), Vector3(0.25 * way),
                               Vector3(0.5 * way), way}) {
    if (place_fan(state, work.fan, start + shift, limits, work.trial, work.spokes)) {
      std::swap(work.fan, work.trial);
      store_fan(state, node, work);
      return true;
    }
  }
  return false;
}

/// Flips the first edge of a triangle with too small an angle that this helps.
bool mend_triangle(RefinementState& state, std::int32_t triangle) {
  if (state.facet(triangle).largest_cosine <= state.cosine_limit) return false;
  for (std::int32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
    const FlipFacets flip = flip_facets(state, h);
    if (!flip.acceptable(flip.largest_cosine() - smallest_mending) ||
        !flip_may_turn(state, h, flip)) {
      continue;
    }
    flip_edge(state, h);
    return true;
  }
  return false;
}

}  // namespace

// Where a scan folds, the outermost sheet has cliffs that the nodes' start on it follows badly. The
// guard of the descent only keeps angles from getting worse, so it would never leave such a start.
void mend_angles(RefinementState& state, const Execution& execution) {
  // The angles of a random start, 1 degree and less, are mended in four or five.
  constexpr int passes = 10;
  for (int pass = 0; pass < passes; ++pass) {
    int changes = 0;
    const auto count = static_cast<std::int32_t>(state.triangulation.triangles().size());
    for (std::int32_t t = 0; t < count; ++t) changes += mend_triangle(state, t) ? 1 : 0;
    changes += for_each_node(
        state, [&](std::int32_t node, FanWorkspace& work) { return mend_node(state, node, work); },
        execution);
    if (changes == 0) return;
  }
}

}  // namespace wscvt
