// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Closed, star-shaped mesh with the given points as vertices, in any order: the Delaunay
/// triangulation of their directions from the centre of what they enclose. This is how a scan given
/// as points without faces enters (the paper's starting point). Equal points are merged.
///
/// Throws Error(InvalidInput) for fewer than 4 different points or coordinates that are not finite,
/// Error(NumericalFailure) when the points do not surround their centre or two lie on one ray.
IndexedMesh mesh_of_points(std::vector<Vector3> points);

}  // namespace wscvt
