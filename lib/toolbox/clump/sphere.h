// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// One sphere of a clump; length.
struct Sphere {
  Vector3 centre = Vector3::Zero();
  double radius = 0.0;

  /// Returns the distance of `point` to the sphere's surface, negative inside.
  double distance(const Vector3& point) const { return (point - centre).norm() - radius; }
};

}  // namespace wscvt
