// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_moves.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace wscvt {

namespace {

/// Nodes in classes without neighbours, nor nodes across an edge from each other, each node in the
/// first that these leave free, in the order of the nodes: the classes, and with them the result,
/// do not depend on the threads.
std::vector<std::vector<std::int32_t>> colour_nodes(const RefinementState& state) {
  const std::size_t count = state.nodes.size();
  std::vector<int> colour(count, -1);
  std::vector<std::vector<std::int32_t>> classes;
  std::vector<std::int32_t> ring;
  std::vector<std::int32_t> outer;
  std::vector<char> taken;
  for (std::size_t i = 0; i < count; ++i) {
    state.ring_of(static_cast<std::int32_t>(i), ring, nullptr);
    taken.assign(classes.size() + 1, 0);
    state.outer_half_edges_of(static_cast<std::int32_t>(i), outer);
    for (const std::int32_t h : outer) ring.push_back(state.corner_left_of(h));
    for (const std::int32_t other : ring) {
      if (colour[other] >= 0) taken[colour[other]] = 1;
    }
    const auto free =
        static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (free == classes.size()) classes.emplace_back();
    colour[i] = static_cast<int>(free);
    classes[free].push_back(static_cast<std::int32_t>(i));
  }
  return classes;
}

bool move_node(RefinementState& state, std::int32_t node, FanWorkspace& work) {
  FanLimits limits = load_fan(state, node, work);
  limits.largest_cosine = std::max(limits.largest_cosine, state.cosine_limit);
  const bool improved = improve_fan(state, work, limits);
  if (!reach_for_outlier(state, work, limits) && !improved) return false;
  store_fan(state, node, work);
  return true;
}

}  // namespace

int for_each_node(const RefinementState& state,
                  const std::function<bool(std::int32_t node, FanWorkspace& work)>& move,
                  const Execution& execution) {
  int moved = 0;
  for (const std::vector<std::int32_t>& nodes : colour_nodes(state)) {
    // Nodes of one colour share no triangle, and none is a corner of a triangle beside another's,
    // whose normal the guard of the turns reads; so they move at the same time.
    moved += execution.parallel_sum(nodes.size(), refinement_block, 0,
                                    [&](std::size_t begin, std::size_t end) {
                                      FanWorkspace work;
                                      int part = 0;
                                      for (std::size_t i = begin; i < end; ++i) {
                                        part += move(nodes[i], work) ? 1 : 0;
                                      }
                                      return part;
                                    });
  }
  return moved;
}

int move_nodes(RefinementState& state, const Execution& execution) {
  return for_each_node(
      state, [&](std::int32_t node, FanWorkspace& work) { return move_node(state, node, work); },
      execution);
}

}  // namespace wscvt
