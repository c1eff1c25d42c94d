// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "wscvt/mesh.h"

namespace wscvt {

/// Signed solid angle in [-2 pi, 2 pi], in steradians, of the triangle a, b, c of unit vectors seen
/// from the origin; positive when they run counter-clockwise seen from outside the sphere (Van
/// Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126, eq. 8).
inline double solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  // Edge vectors keep the relative precision of a triangle far smaller than the sphere.
  const double numerator = a.dot((b - a).cross(c - a));
  const double denominator = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
  if (std::abs(numerator) < 0.02 * denominator) {
    // The arctangent's series, to the last bit in this range: a dense scan has no other triangles.
    const double x = numerator / denominator;
    const double s = x * x;
    return 2.0 * x * (1.0 + s * (-1.0 / 3.0 + s * (0.2 + s * (-1.0 / 7.0 + s * (1.0 / 9.0)))));
  }
  return 2.0 * std::atan2(numerator, denominator);
}

}  // namespace wscvt
