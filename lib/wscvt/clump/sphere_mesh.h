// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/clump/sphere.h"

namespace wscvt {

/// The surface of the union of spheres as a closed, outward mesh, in the spheres' coordinates. Its
/// vertices lie on the spheres, one on each edge of a grid of tetrahedra that leaves the union, to
/// a thousandth of the edge. The grid's spacing is a 60th of the box's longest edge, or a third of
/// the smallest radius where that is less; but it has at most two million points. Hollows within
/// are surfaces of their own. The mesh lies within the union by up to spacing^2 / (8 radius).
/// Throws Error(InvalidInput) for no spheres, or one that is not finite or has no radius.
IndexedMesh sphere_union_mesh(const std::vector<Sphere>& spheres, const Execution& execution);

}  // namespace wscvt
