// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the triangles of the points' convex hull, counter-clockwise seen from outside, as
/// indices into `points` (CGAL::convex_hull_3, exact predicates). Each triangle begins with its
/// smallest index; triangles are in ascending order. If several points are equal, the hull contains
/// one of them. Empty if all points lie in one plane. Uses one thread. Throws Error(Cancelled).
std::vector<Triangle> convex_hull_triangles(const std::vector<Vector3>& points,
                                            const Execution& execution = Execution(1));

/// Returns the convex hull as a closed outward mesh. Its points are the hull's corners, in the
/// order of the input. Throws Error(InvalidInput) if all points lie in one plane, and
/// Error(Cancelled).
IndexedMesh convex_hull(const std::vector<Vector3>& points,
                        const Execution& execution = Execution(1));

}  // namespace wscvt
