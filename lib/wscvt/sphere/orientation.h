// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the exact sign of det(b - a, c - a, d - a): positive if d lies on the side of the plane
/// abc from which abc is counter-clockwise.
///
/// The sign must be exact, because algorithms build on it. Edge flips end only if all signs are
/// consistent. With rounding, both diagonals of four points nearly on one circle may look wrong and
/// are flipped for ever. If a triangle without area passes for a good one, its surroundings turn
/// inside out, and a walk among triangles circles it. CGAL's predicate usually decides by
/// floating-point arithmetic with an error bound, and computes exactly only if that fails.
int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Returns the exact sign of det(a, b, c): positive if the directions a, b, c are counter-clockwise
/// seen from outside the sphere. Their lengths do not matter.
inline int sphere_orientation(const Vector3& a, const Vector3& b, const Vector3& c) {
  return orientation(Vector3::Zero(), a, b, c);
}

/// Whether abc is counter-clockwise seen from outside the sphere, exactly: det(a, b, c) > 0.
inline bool counter_clockwise(const Vector3& a, const Vector3& b, const Vector3& c) {
  return sphere_orientation(a, b, c) > 0;
}

}  // namespace wscvt
