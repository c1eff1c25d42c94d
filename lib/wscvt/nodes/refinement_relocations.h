// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/nodes/refinement_state.h"

namespace wscvt {

/// Takes nodes from where they help least, their triangles joined to a neighbour, to where they
/// help most, an edge split, as long as that pays; returns how many. At most one relocation touches
/// a triangle. Throws Error(NumericalFailure) when a trial cannot be repeated.
int relocate_nodes(RefinementState& state, const Execution& execution);

}  // namespace wscvt
