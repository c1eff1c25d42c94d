// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/pi.h"
#include "wscvt/nodes/refinement_target.h"

namespace wscvt {

/// One triangle of a mesh that is being refined: its plane, and what the guards ask about it. Until
/// it is given corners, and when these lie on a line, it is not counter-clockwise.
struct RefinementFacet {
  Vector3 corner = Vector3::Zero();  ///< one of the three, length
  Vector3 normal = Vector3::Zero();  ///< unit, outward for counter-clockwise corners
  bool counter_clockwise = false;    ///< on the sphere of directions, and far from edge-on there
  double largest_cosine = 1.0;       ///< of its smallest angle

  RefinementFacet() = default;
  RefinementFacet(const RefinementNode& a, const RefinementNode& b, const RefinementNode& c);

  /// Height of a point above the plane; length.
  double residual(const Vector3& point) const { return normal.dot(point - corner); }

  /// Whether the refinement may make this triangle: counter-clockwise on the sphere, and without an
  /// angle of a larger cosine than `cosine_limit`.
  bool acceptable(double cosine_limit) const {
    return counter_clockwise && largest_cosine <= cosine_limit;
  }
};

/// Angles are compared by their cosines, which saves an arc cosine a triangle tried.
inline double cosine_of_degrees(double degrees) { return std::cos(degrees * pi / 180.0); }

/// What small angles of triangles count besides distances: nothing down to a goal, and below it the
/// weight times the square of how far the angle's cosine is on the way from the goal's to 1. A
/// square, so that Gauss-Newton steps lower it as they lower distances.
struct AnglePenalty {
  double goal_cosine = 1.0;
  double weight = 0.0;  ///< what a triangle with an angle of 0 counts; 0 when angles do not count

  /// 0 where no angle is below the goal, 1 where one is 0.
  double excess(const RefinementFacet& facet) const {
    return facet.largest_cosine > goal_cosine
               ? (facet.largest_cosine - goal_cosine) / (1.0 - goal_cosine)
               : 0.0;
  }
  double operator()(const RefinementFacet& facet) const {
    if (!(weight > 0.0)) return 0.0;
    const double beyond = excess(facet);
    return weight * beyond * beyond;
  }
};

/// Unit normal of a triangle, outward for counter-clockwise corners; shorter or no number where the
/// corners lie on a line.
Vector3 facet_normal(const Vector3& a, const Vector3& b, const Vector3& c);

}  // namespace wscvt
