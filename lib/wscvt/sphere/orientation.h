// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// `orientation` by exact arithmetic: what the filter below falls back on.
int exact_orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Exact sign of det(b - a, c - a, d - a): positive when d lies on the side of the plane abc from
/// which abc is counter-clockwise. The filter is stage A of Shewchuk (1997), "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates", section 4.3.
inline int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const double bx = b.x() - a.x(), by = b.y() - a.y(), bz = b.z() - a.z();
  const double cx = c.x() - a.x(), cy = c.y() - a.y(), cz = c.z() - a.z();
  const double dx = d.x() - a.x(), dy = d.y() - a.y(), dz = d.z() - a.z();
  const double bxcy = bx * cy, cxby = cx * by;
  const double cxdy = cx * dy, dxcy = dx * cy;
  const double dxby = dx * by, bxdy = bx * dy;
  const double determinant = dz * (bxcy - cxby) + bz * (cxdy - dxcy) + cz * (dxby - bxdy);
  const double permanent = (std::abs(bxcy) + std::abs(cxby)) * std::abs(dz) +
                           (std::abs(cxdy) + std::abs(dxcy)) * std::abs(bz) +
                           (std::abs(dxby) + std::abs(bxdy)) * std::abs(cz);
  constexpr double epsilon = 0.5 * std::numeric_limits<double>::epsilon();
  const double bound = (7.0 + 56.0 * epsilon) * epsilon * permanent;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return exact_orientation(a, b, c, d);
}

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
