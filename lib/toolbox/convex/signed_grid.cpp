// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/signed_grid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

SignedGrid::SignedGrid(const IndexedMesh& mesh, int cells, const Execution& execution)
    : distance_(mesh, execution) {
  const Eigen::AlignedBox3d box = box_of(mesh.points);
  const Vector3 size = box.sizes();
  spacing_ = size.maxCoeff() / cells;
  origin_ = box.min() - Vector3::Constant(spacing_);
  for (int axis = 0; axis < 3; ++axis) {
    counts_[axis] = static_cast<int>(std::ceil(size[axis] / spacing_)) + 3;
  }
  values_.resize(index(0, 0, counts_[2]));
  const auto rows = static_cast<std::size_t>(counts_[1]) * static_cast<std::size_t>(counts_[2]);
  execution.parallel_for_each(rows, 16, [&](std::size_t row) {
    const int j = static_cast<int>(row) % counts_[1];
    const int k = static_cast<int>(row) / counts_[1];
    // The first point of a row is outside the box.
    double sign = 1.0;
    double before = 0.0;
    for (int i = 0; i < counts_[0]; ++i) {
      const Vector3 point = origin_ + spacing_ * Vector3(i, j, k);
      const double length = distance_.distance(point);
      // Two grid neighbours on opposite sides have distances that sum to at most their spacing,
      // but for rounding.
      if (i > 0 && before + length <= (1.0 + 1e-9) * spacing_)
        sign = distance_.contains(point) ? -1.0 : 1.0;
      values_[index(i, j, k)] = sign * length;
      before = length;
    }
  });
}

double SignedGrid::distance_outside(const Vector3& point) const {
  // If the grid takes a point for an outer one by its error, the distance is as small.
  return at(point) > 0.0 ? distance_.distance(point) : 0.0;
}

double SignedGrid::at(const Vector3& point) const {
  std::array<int, 3> cell{};
  Vector3 part;
  for (int axis = 0; axis < 3; ++axis) {
    const int last = counts_[axis] - 1;
    const double place =
        std::clamp((point[axis] - origin_[axis]) / spacing_, 0.0, static_cast<double>(last));
    const int first = std::min(static_cast<int>(place), last - 1);
    cell[axis] = first;
    part[axis] = place - first;
  }
  double value = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<int, 3> at = cell;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = ((corner >> axis) & 1) != 0;
      weight *= upper ? part[axis] : 1.0 - part[axis];
      at[axis] += upper ? 1 : 0;
    }
    value += weight * values_[index(at[0], at[1], at[2])];
  }
  return value;
}

}  // namespace wscvt
