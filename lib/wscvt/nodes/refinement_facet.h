// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// One triangle of a mesh that is being refined: its plane, and what the guards ask about it. Until
/// it is given corners, and when these lie on a line, it is not star-shaped.
struct RefinementFacet {
  Vector3 corner = Vector3::Zero();  ///< one of the three, length
  Vector3 normal = Vector3::Zero();  ///< unit, outward for counter-clockwise corners
  bool star_shaped = false;     ///< its plane passes the origin on the inner side, far from edge-on
  double largest_cosine = 1.0;  ///< of its smallest angle

  RefinementFacet() = default;
  RefinementFacet(const Vector3& a, const Vector3& b, const Vector3& c);

  /// Height of a point above the plane; length.
  double residual(const Vector3& point) const { return normal.dot(point - corner); }

  /// Whether the refinement may make this triangle: seen counter-clockwise from the origin, and
  /// without an angle of a larger cosine than `cosine_limit`.
  bool acceptable(double cosine_limit) const {
    return star_shaped && largest_cosine <= cosine_limit;
  }
};

}  // namespace wscvt
