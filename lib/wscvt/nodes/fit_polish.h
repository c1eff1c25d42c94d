// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Moves nodes of sharp triangles, and in the late rounds those near samples that lie far off, one
/// by one to where they cost less, up to `passes` times over. Returns how many moves were made. The
/// samples' lists must be up to date, and are.
int polish_nodes(FitState& state, int passes);

/// Triangles that stay below `least_angle` degrees: one node of each moves by the least step that
/// mends its angles, or towards the middle of its ring, to where that costs the distance least.
/// Returns how many moved.
int mend_angles(FitState& state, double least_angle);

}  // namespace wscvt
