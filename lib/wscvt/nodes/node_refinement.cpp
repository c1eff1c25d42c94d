// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/node_refinement.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/nodes/refinement_angles.h"
#include "wscvt/nodes/refinement_facet.h"
#include "wscvt/nodes/refinement_flips.h"
#include "wscvt/nodes/refinement_moves.h"
#include "wscvt/nodes/refinement_relocations.h"
#include "wscvt/nodes/refinement_state.h"

namespace wscvt {

namespace {

/// The first rounds lower the distance by so much that relocations would be misjudged.
constexpr int rounds_without_relocations = 2;

/// Trying them all takes twice as long as the rest of a round; once there are hardly any left, one
/// for so many nodes, which is after five rounds or so, they are tried again when moves and flips
/// have made room for more.
constexpr int nodes_a_relocation = 100;
constexpr int rounds_after_few = 3;

/// A limit on the angles that no step may cross ends the descent early: nodes get stuck where a
/// triangle beside them is at the limit, and at 30 degrees nearly every relocation is forbidden,
/// since a node on the edge of an equilateral triangle splits it at exactly 30. So angles below the
/// limit are allowed at first and cost something, which grows from round to round until there are
/// none (the quadratic penalty method: Nocedal and Wright 2006, "Numerical Optimization", section
/// 17.1). With 1000 nodes eight bodies with undercuts came an eighth to a quarter nearer to the
/// scan, a slab with sharp rims two fifths; of a box's distance at the start 0.01 is left instead
/// of 0.29 (NodeRefinement.AnglesBelowTheLimit...). It takes up to five times as long.
struct AngleSchedule {
  /// What an angle of 0 costs in the first round and in the last planned, see
  /// RefinementState::measure. From 0.1 on sharp places took nodes that did not come back, from 3
  /// on less was gained.
  static constexpr double first_strength = 1.0;
  static constexpr double last_strength = 1e4;
  /// Above it the distance hardly changes any more, so that the end may come once no angle is
  /// small.
  static constexpr double settled_strength = 100.0;
  /// Beyond the limit, in degrees, so that what is held against it need not be exact.
  static constexpr double margin = 0.5;
  /// Of the limit: the smallest angle while those below the limit cost.
  static constexpr double share_allowed = 0.5;
  /// 24, to a strength of 3e3, come as near to smooth bodies, but leave 0.1 of that box's distance.
  static constexpr int most_planned_rounds = 30;
  /// In fewer, angles are mended at more cost than the detour gains.
  static constexpr int fewest_rounds = 4;
  /// Where the sphere's guard holds a triangle, no cost mends it.
  static constexpr int rounds_beyond_plan = 5;

  int rounds = 0;  ///< at most so many
  double growth = 1.0;

  explicit AngleSchedule(const RefinementOptions& options) {
    const int most = 3 * options.rounds / 4;
    if (most < fewest_rounds || !(options.smallest_angle > 0.0)) return;
    const int planned = std::min(most, most_planned_rounds);
    rounds = std::min(most, planned + rounds_beyond_plan);
    growth = std::pow(last_strength / first_strength, 1.0 / (planned - 1));
  }
};

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
  const AngleSchedule schedule(options);
  const double limit = state.cosine_limit;
  double strength = 0.0;  // of what small angles cost; 0 where none is allowed
  if (schedule.rounds > 0) {
    state.cosine_limit = cosine_of_degrees(schedule.share_allowed * options.smallest_angle);
    state.angle_penalty.goal_cosine = cosine_of_degrees(options.smallest_angle + schedule.margin);
    strength = schedule.first_strength;
  }
  report.start_distance = state.measure(execution, strength);
  const int few_relocations = static_cast<int>(state.nodes.size()) / nodes_a_relocation;
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
    const bool gains = std::sqrt(state.error() / before) < 1.0 - options.tolerance;
    if (strength == 0.0) {
      report.converged = !gains;
    } else if (round + 1 == schedule.rounds || ((!gains || strength > schedule.settled_strength) &&
                                                state.count_sharper(limit) == 0)) {
      state.cosine_limit = limit;
      strength = 0.0;
    } else {
      strength *= schedule.growth;
    }
    step.distance = state.measure(execution, strength);
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
