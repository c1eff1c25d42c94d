// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Moves nodes from where they are needed least to where they gain most, by the round's errors: a
/// node is merged into a neighbour, and put on an edge elsewhere. This pairs the collapses and
/// splits of the mesh optimization of Hoppe et al. 1993, so that the number of nodes stays. Moves
/// at most 6 % of the nodes per round, and no two of them whose triangles touch. Returns the number
/// of moves. Needs up-to-date lists of samples and updates them. The result does not depend on the
/// number of threads.
int relocate_nodes(FitState& state, const Execution& execution);

}  // namespace wscvt
