// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Computes a step of all nodes at once from a linear least-squares problem. The planes of the
/// triangles move to their samples, as in the mesh optimization of Hoppe et al. 1993 (SIGGRAPH,
/// 19), but along the mean of the scan's and the triangle's normals. Edges keep their rest lengths,
/// and nodes the middles of their rings. Solved by 15 steps of conjugate gradients over blocks of 3
/// by 3; full accuracy is not needed, because the next round solves again. A sparse factorization
/// would take ten times as long.
///
/// Also sets `state.ring_edges`. The result does not depend on the number of threads.
std::vector<Vector3> fit_step(FitState& state, const Execution& execution);

}  // namespace wscvt
