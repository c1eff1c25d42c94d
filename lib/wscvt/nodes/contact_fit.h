// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

/// Moves the nodes of a mesh so that contacts found by the deepest node come where the grain's own
/// would: balls of `ball_radius` equivalent radii are laid to the grain from outside, evenly over
/// the surface of their centres, which is how bodies flung at it along random lines would meet it;
/// and the nodes lie where the sum of squares of the gap between each ball and the node nearest to
/// it is least. It runs over 60 balls a node (at most 120,000), 30 Gauss-Newton steps with the
/// nearest nodes anew each time, and gives the best positions seen.
///
/// Small balls reach between the nodes as corners of a neighbour do, so the smaller they are the
/// farther out the nodes lie.
///
/// The mesh keeps its triangles, and no step is taken that would turn one by more than some 70
/// degrees from where it was, or inward seen from the origin. Nodes that no ball comes nearest to,
/// as those in hollows, stay. `mesh` and `grain` are closed and outward, about the origin; lengths
/// of both are equivalent radii. `to_grain` is the distance to `grain` where the caller has it, and
/// made here where it is nullptr. The same bits on any number of threads. Throws
/// Error(InvalidInput) for a radius that is not positive or a grain without faces,
/// Error(Cancelled).
std::vector<Vector3> fit_to_contacts(const IndexedMesh& mesh, const IndexedMesh& grain,
                                     const MeshDistance* to_grain, double ball_radius,
                                     const Execution& execution);

}  // namespace wscvt
