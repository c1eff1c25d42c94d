// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

/// Returns the signed solid angle in [-2 pi, 2 pi], in steradians, of the triangle of unit vectors
/// a, b, c seen from the origin. It is positive if they are counter-clockwise seen from outside the
/// sphere (Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126, eq. 8).
inline double solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  // Edge vectors keep the relative precision of a triangle far smaller than the sphere.
  const double numerator = a.dot(doubled_area_normal(a, b, c));
  const double denominator = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
  if (std::abs(numerator) < 0.02 * denominator) {
    // The arctangent's series, exact to the last bit in this range. A dense scan has only such
    // triangles.
    const double x = numerator / denominator;
    const double s = x * x;
    return 2.0 * x * (1.0 + s * (-1.0 / 3.0 + s * (0.2 + s * (-1.0 / 7.0 + s * (1.0 / 9.0)))));
  }
  return 2.0 * portable::atan2(numerator, denominator);
}

/// Sums of the solid angles of a closed surface's faces.
struct SolidAngleSums {
  double outward = 0.0;   ///< of the faces that look away from the origin
  double backward = 0.0;  ///< of the faces that look towards it, >= 0
  bool touched = false;   ///< a face fills half the sphere: the origin lies on it

  void add(double angle) {
    constexpr double half_sphere = 2.0 * pi - 1e-9;
    (angle < 0.0 ? backward : outward) += std::abs(angle);
    touched = touched || std::abs(angle) > half_sphere;
  }

  SolidAngleSums& operator+=(const SolidAngleSums& other) {
    outward += other.outward;
    backward += other.backward;
    touched = touched || other.touched;
    return *this;
  }

  /// See overhang_solid_angle in overhangs.h.
  double overhang_fraction() const {
    constexpr double four_pi = 4.0 * pi;
    // The signed angles sum to 4 pi seen from inside and to 0 seen from outside.
    const bool inside = !touched && outward - backward > 0.5 * four_pi;
    const double folded = 2.0 * backward / four_pi;  // an equal amount looks outward
    return inside ? folded : 1.0 + folded;
  }
};

}  // namespace wscvt
