// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/nodes/refinement_state.h"

namespace wscvt {

/// Flips edges, and moves nodes by the angles' slope or towards the middle of their neighbours,
/// where an angle is smaller than allowed, whatever that does to the distance; gives up after ten
/// passes.
void mend_angles(RefinementState& state, const Execution& execution);

}  // namespace wscvt
