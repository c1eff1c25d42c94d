// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Moves the nodes by a step of each, at most a third of an edge long, which is shortened at the
/// nodes of triangles that it would turn over, make sharp, turn against the scan, fold, or drive
/// through others. Triangles that stand against the scan already, as in the walls of a notch in a
/// rim, may do what makes them no worse. Builds `state.hash` anew; samples are to be placed after.
/// The same on any number of threads.
void move_nodes(FitState& state, std::vector<Vector3> step, const Execution& execution);

}  // namespace wscvt
