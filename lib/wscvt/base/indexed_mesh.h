// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace wscvt {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// Three indices into the points, counter-clockwise seen from outside.
using Triangle = std::array<std::int32_t, 3>;

/// Points and triangles in flat arrays, without half-edges. Scans are stored and geometry is
/// computed in this form.
struct IndexedMesh {
  std::vector<Vector3> points;
  std::vector<Triangle> triangles;
};

}  // namespace wscvt
