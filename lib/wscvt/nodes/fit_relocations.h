// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Takes nodes from where they are missed least to where they gain most, by the errors that the
/// round counts: a node is merged into a neighbour, as in edge collapses, and put on an edge
/// elsewhere, as in the mesh optimization of Hoppe et al. 1993, whose collapses and splits this
/// pairs so that the number of nodes stays. At most a twentieth of them a round, none of whose
/// triangles touch. Returns how many moved. The samples' lists must be up to date, and are. The
/// same on any number of threads.
int relocate_nodes(FitState& state, const Execution& execution);

}  // namespace wscvt
