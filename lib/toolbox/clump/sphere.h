// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// One sphere of a clump; length.
struct Sphere {
  Vector3 centre = Vector3::Zero();
  double radius = 0.0;

  /// Returns the distance of `point` to the sphere's surface, negative inside.
  double distance(const Vector3& point) const { return (point - centre).norm() - radius; }
};

/// Returns the surface of the union of spheres as a closed, outward mesh, in the spheres'
/// coordinates. Its vertices lie on the spheres to a thousandth of an edge of a grid of tetrahedra:
/// one vertex on each edge that leaves the union. The grid's spacing is the smaller of a 60th of
/// the box's longest edge and a third of the smallest radius, but the grid has at most two million
/// points. Hollows within are separate surfaces. The mesh lies within the union by up to spacing^2
/// / (8 radius). Throws Error(InvalidInput) for no spheres, or for a sphere that is not finite or
/// has no radius.
IndexedMesh sphere_union_mesh(const std::vector<Sphere>& spheres, const Execution& execution);

}  // namespace wscvt
