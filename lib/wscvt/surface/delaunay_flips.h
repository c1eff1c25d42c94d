// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/surface/edit_mesh.h"

namespace wscvt {

/// Flips edges towards the Delaunay triangulation of a surface, once over all of them. No face
/// turns against its surface. Sharp edges, as at rims, are flipped if the faces then turn less: the
/// sum of 1 - cos over the edge and the four about it falls, as in the criterion of the angle
/// between normals of Dyn, Levin, Rippa 1990 (IMA J. Numer. Anal. 10, 137).
/// `outward` has a vector per vertex that points out of the surface, with the length of its area,
/// or all with one length. Returns the number of flips.
int flip_to_delaunay(EditMesh& mesh, const std::vector<Vector3>& outward);

/// Returns the cosine of the angle between a face's unit normal and the surface's direction; 1 if
/// the direction is zero.
inline double cosine_to(const Vector3& unit_normal, const Vector3& direction) {
  const double length = direction.norm();
  return length > 1e-300 ? unit_normal.dot(direction) / length : 1.0;
}

/// Smallest cosine to its surface's direction at which a face has not turned against it: 78
/// degrees.
inline constexpr double least_agreement = 0.2;

}  // namespace wscvt
