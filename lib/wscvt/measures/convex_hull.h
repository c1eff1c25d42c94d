// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The convex hull of the points as a closed outward mesh (CGAL::convex_hull_3, exact predicates);
/// its points are those of the input that lie on it. Throws Error(InvalidInput) when all points lie
/// in one plane.
IndexedMesh convex_hull(const std::vector<Vector3>& points);

}  // namespace wscvt
