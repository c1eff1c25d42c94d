// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The triangles of the points' convex hull, counter-clockwise seen from outside, as indices into
/// `points` (CGAL::convex_hull_3, exact predicates): each from its smallest index on, in ascending
/// order. Of points in one place the hull names one.
/// Empty when all points lie in one plane. Takes one thread. Throws Error(Cancelled).
std::vector<Triangle> convex_hull_triangles(const std::vector<Vector3>& points,
                                            const Execution& execution = Execution(1));

/// The convex hull as a closed outward mesh; its points are those of the input that lie on it, in
/// their order. Throws Error(InvalidInput) when all points lie in one plane, Error(Cancelled).
IndexedMesh convex_hull(const std::vector<Vector3>& points,
                        const Execution& execution = Execution(1));

}  // namespace wscvt
