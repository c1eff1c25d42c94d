// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Moves each node by its step, limited to 0.35 of an edge. A step is shortened at the nodes of
/// triangles that it would turn over, make sharp, turn against the scan, fold, or push through
/// others. Triangles that face against the scan already, as in the walls of a notch in a rim, may
/// move as long as they get no worse. Rebuilds `state.hash`; afterwards place the samples again.
/// The result does not depend on the number of threads.
void move_nodes(FitState& state, std::vector<Vector3> step, const Execution& execution);

}  // namespace wscvt
