// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/node_refinement.h"

#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/nodes/refinement_angles.h"
#include "wscvt/nodes/refinement_flips.h"
#include "wscvt/nodes/refinement_moves.h"
#include "wscvt/nodes/refinement_relocations.h"
#include "wscvt/nodes/refinement_state.h"

namespace wscvt {

namespace {

/// The first rounds lower the distance by so much that relocations would be misjudged.
constexpr int rounds_without_relocations = 2;

/// Trying them all takes as long as the rest of a round; once there are hardly any left, which is
/// after eight rounds or so, they are tried again when moves and flips have made room for more.
constexpr int few_relocations = 2;
constexpr int rounds_after_few = 5;

}  // namespace

void check_refinement_options(const RefinementOptions& options) {
  require_in_range(options.rounds, refinement_rounds_option);
  require_in_range(options.smallest_angle, refinement_angle_option);
  require_in_range(options.tolerance, refinement_tolerance_option);
}

RefinedNodes refine_nodes(std::vector<RefinementNode> nodes, SphereTriangulation triangulation,
                          const RefinementTarget& original, const RefinementOptions& options,
                          const Execution& execution) {
  check_refinement_options(options);
  RefinementReport report;
  if (options.rounds == 0) return {std::move(nodes), std::move(triangulation), report};
  RefinementState state(std::move(nodes), std::move(triangulation), original,
                        options.smallest_angle, execution);
  report.start_distance = state.measure(execution);
  int next_relocations = rounds_without_relocations;
  for (int round = 0; round < options.rounds && !report.converged; ++round) {
    // A round takes seconds on many nodes; a cancel should not have to wait for its end.
    const auto reached = [&](double share_of_round) {
      execution.report((round + share_of_round) / options.rounds, "Refining the nodes");
    };
    reached(0.0);
    // Not part of what convergence is judged by: mending may raise the error.
    mend_angles(state, execution);
    reached(0.1);
    const double before = state.error();
    RefinementStep step;
    step.moves = move_nodes(state, execution);
    reached(0.5);
    step.flips = flip_edges(state, execution);
    reached(0.6);
    if (round >= next_relocations) {
      step.relocations = relocate_nodes(state, execution);
      if (step.relocations <= few_relocations) next_relocations = round + rounds_after_few;
    }
    // 0 / 0, on a mesh that is the original, is no gain either.
    const double share = std::sqrt(state.error() / before);
    report.converged = !(share < 1.0 - options.tolerance);
    step.distance = state.measure(execution);
    report.history.push_back(step);
  }
  return {std::move(state.nodes), std::move(state.triangulation), std::move(report)};
}

std::vector<RefinementNode> radial_nodes(const std::vector<Vector3>& positions) {
  std::vector<RefinementNode> nodes;
  nodes.reserve(positions.size());
  for (const Vector3& p : positions) nodes.push_back({p, p, {}});
  return nodes;
}

std::vector<RefinementNode> mapped_nodes(const std::vector<Vector3>& positions,
                                         const std::vector<Vector3>& directions,
                                         const MappedSurface& surface, const Execution& execution) {
  const std::vector<MeshPlace> places = surface.locate(directions, execution);
  std::vector<RefinementNode> nodes;
  nodes.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    nodes.push_back({positions[i], directions[i], places[i]});
  }
  return nodes;
}

std::vector<Vector3> positions_of(const std::vector<RefinementNode>& nodes) {
  std::vector<Vector3> positions;
  positions.reserve(nodes.size());
  for (const RefinementNode& node : nodes) positions.push_back(node.position);
  return positions;
}

void scale(RefinementReport& report, double unit) {
  report.start_distance *= unit;
  for (RefinementStep& step : report.history) step.distance *= unit;
}

}  // namespace wscvt
