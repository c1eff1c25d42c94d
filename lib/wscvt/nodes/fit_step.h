// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// The step of all nodes at once that a linear least-squares problem wants: samples come to lie in
/// the planes of their triangles, as in the mesh optimization of Hoppe et al. 1993 (SIGGRAPH, 19),
/// but along the mean of the scan's and the triangle's normals; nodes come to lie where the planes
/// of the scan in their cells cross, by the quadrics of Garland and Heckbert 1997 (SIGGRAPH, 209),
/// where these planes turn about a ridge (as the normals in the Voronoi energy of Xu et al. 2024,
/// ACM Trans. Graph. 43, "CWF", do); and edges keep their rest lengths, nodes the middles of their
/// rings. Solved by conjugate gradients over blocks of 3 by 3, which take 15 steps, for less than
/// all digits: the next round asks anew. A sparse factorization would take ten times as long.
///
/// Also sets `state.ring_edges`. The same on any number of threads.
std::vector<Vector3> fit_step(FitState& state, const Execution& execution);

}  // namespace wscvt
