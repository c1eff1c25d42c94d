// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/refinement_fan.h"
#include "wscvt/nodes/refinement_state.h"

namespace wscvt {

/// Calls `move` for every node, for nodes that share no triangle at the same time, and returns how
/// often it said true. `move` may change the node and the triangles about it, and read its ring and
/// the triangles across the ring's edges. Same bytes on any number of threads.
int for_each_node(const RefinementState& state,
                  const std::function<bool(std::int32_t node, FanWorkspace& work)>& move,
                  const Execution& execution);

/// Moves every node by a Gauss-Newton step in the triangles about it, if that lowers their error;
/// returns how many moved.
int move_nodes(RefinementState& state, const Execution& execution);

}  // namespace wscvt
