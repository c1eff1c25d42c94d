// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Exact sign of det(b - a, c - a, d - a): positive when d lies on the side of the plane abc from
/// which abc is counter-clockwise.
///
/// Exact, because what asks goes on from the answer. Edge flips end only if all answers fit one set
/// of points: with rounding, both diagonals of four points that are nearly on one circle may look
/// wrong, and are flipped for ever. A triangle of no area that passes for a good one turns what
/// lies behind it inside out, and a walk among triangles runs in circles about it. CGAL's predicate
/// nearly always decides by floating-point arithmetic with an error bound, and computes exactly
/// only where that does not.
int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Exact sign of det(a, b, c): positive when the directions a, b, c run counter-clockwise seen from
/// outside the sphere; their lengths do not matter.
inline int sphere_orientation(const Vector3& a, const Vector3& b, const Vector3& c) {
  return orientation(Vector3::Zero(), a, b, c);
}

/// Whether abc is counter-clockwise seen from outside the sphere, exactly: det(a, b, c) > 0.
inline bool counter_clockwise(const Vector3& a, const Vector3& b, const Vector3& c) {
  return sphere_orientation(a, b, c) > 0;
}

}  // namespace wscvt
