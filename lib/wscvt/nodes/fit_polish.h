// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Moves nodes of sharp triangles, and in the late rounds nodes near distant samples, one by one to
/// positions of lower cost, in up to `passes` passes. Returns the number of moves. Needs up-to-date
/// lists of samples and updates them.
int polish_nodes(FitState& state, int passes);

/// Repairs triangles with an angle below `least_angle` degrees. One node of each moves by the
/// smallest step that enlarges the angles, or towards the middle of its ring, to the position that
/// adds least distance. Returns the number of moves.
int mend_angles(FitState& state, double least_angle);

}  // namespace wscvt
