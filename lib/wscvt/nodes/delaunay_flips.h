// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/nodes/edit_mesh.h"

namespace wscvt {

/// Flips edges towards the Delaunay triangulation of a surface, once over all of them, and leaves
/// the shape: no edge gets sharper, and no face turns against the surface that it stands for.
/// Where two faces stand as walls in a notch of a sharp rim, the edge that closes the notch is
/// taken, Delaunay or not. `outward` has a vector a vertex that points out of the surface about it,
/// as long as the area that it stands for, or all of one length. Returns how many were flipped.
int flip_to_delaunay(EditMesh& mesh, const std::vector<Vector3>& outward);

/// Cosine of the angle between a face's unit normal and the direction that the surface looks;
/// 1 where that has none.
inline double cosine_to(const Vector3& unit_normal, const Vector3& direction) {
  const double length = direction.norm();
  return length > 1e-300 ? unit_normal.dot(direction) / length : 1.0;
}

/// A face that looks less than this along the surface it stands for has turned against it: 78
/// degrees.
inline constexpr double least_agreement = 0.2;

}  // namespace wscvt
