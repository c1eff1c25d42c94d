// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_facet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace wscvt {

namespace {

/// A triangle of directions whose plane passes the sphere's centre at less than this share of their
/// length is too steep. Over a radial map, where directions are positions, the signed volume of
/// triangle and origin is area / 3 times that distance; its rounding is 1e-16 of its terms, so that
/// what passes with 1e-3 is star-shaped beyond doubt, also after the mesh was scaled, moved and
/// written in single precision (1e-7). No face of a scan that is worth following is steeper: 1e-3
/// is 3.4 minutes of arc.
constexpr double smallest_plane_cosine = 1e-3;

bool is_counter_clockwise(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = (b - a).cross(c - b);
  const double length = std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
  return normal.dot(a) > smallest_plane_cosine * normal.norm() * length;
}

}  // namespace

Vector3 facet_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = (b - a).cross(c - b);
  const double doubled_area = normal.norm();
  return doubled_area > 0.0 ? Vector3(normal / doubled_area) : normal;
}

RefinementFacet::RefinementFacet(const RefinementNode& a, const RefinementNode& b,
                                 const RefinementNode& c)
    : corner(a.position), normal(facet_normal(a.position, b.position, c.position)) {
  // Written so that a NaN counts as no triangle.
  if (!(normal.squaredNorm() > 0.5)) return;
  const Vector3 ab = b.position - a.position;
  const Vector3 bc = c.position - b.position;
  const Vector3 ca = a.position - c.position;
  counter_clockwise = is_counter_clockwise(a.direction, b.direction, c.direction);
  const double ab_length = ab.norm();
  const double bc_length = bc.norm();
  const double ca_length = ca.norm();
  largest_cosine =
      std::max({-ca.dot(ab) / (ca_length * ab_length), -ab.dot(bc) / (ab_length * bc_length),
                -bc.dot(ca) / (bc_length * ca_length)});
}

}  // namespace wscvt
