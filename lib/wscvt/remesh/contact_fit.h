// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Moves the nodes of a mesh so that, on average, contacts found by the deepest node start where
/// the grain's own contacts would. Balls of `ball_radius` equivalent radii touch the grain from
/// outside, evenly over the surface of their centres, as bodies thrown at it along random lines
/// would. The nodes minimize the sum of squares of the gap between each ball and its nearest node.
/// Uses 60 balls per node (at most 120,000) and 30 Gauss-Newton steps, each with new nearest nodes,
/// and returns the best positions.
///
/// Small balls reach between the nodes as a neighbour's corners do, so smaller balls move the nodes
/// farther out.
///
/// The mesh keeps its triangles. No step turns a triangle by more than some 70 degrees from its
/// start, or inward seen from the origin. Nodes that are nearest to no ball, such as nodes in
/// hollows, stay. `mesh` and `grain` are closed and outward, about the origin; lengths are
/// equivalent radii. The result does not depend on the number of threads. Throws
/// Error(InvalidInput) for a radius that is not positive or a grain without faces,
/// Error(Cancelled).
std::vector<Vector3> fit_to_contacts(const IndexedMesh& mesh, const IndexedMesh& grain,
                                     double ball_radius, const Execution& execution);

}  // namespace wscvt
