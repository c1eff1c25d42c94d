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

}  // namespace

void check_refinement_options(const RefinementOptions& options) {
  require_in_range(options.rounds, refinement_rounds_option);
  require_in_range(options.smallest_angle, refinement_angle_option);
  require_in_range(options.tolerance, refinement_tolerance_option);
}

RefinedNodes refine_nodes(std::vector<Vector3> positions, SphereTriangulation triangulation,
                          const MeshSurface& original, const RefinementOptions& options,
                          const Execution& execution) {
  check_refinement_options(options);
  RefinementReport report;
  if (options.rounds == 0) return {std::move(positions), std::move(triangulation), report};
  RefinementState state(std::move(positions), std::move(triangulation), original,
                        options.smallest_angle, execution);
  report.start_distance = state.measure(execution);
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
    if (round >= rounds_without_relocations) step.relocations = relocate_nodes(state, execution);
    // 0 / 0, on a mesh that is the original, is no gain either.
    const double share = std::sqrt(state.error() / before);
    report.converged = !(share < 1.0 - options.tolerance);
    step.distance = state.measure(execution);
    report.history.push_back(step);
  }
  return {std::move(state.positions), std::move(state.triangulation), std::move(report)};
}

void scale(RefinementReport& report, double unit) {
  report.start_distance *= unit;
  for (RefinementStep& step : report.history) step.distance *= unit;
}

}  // namespace wscvt
