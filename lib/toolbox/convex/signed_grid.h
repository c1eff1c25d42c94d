// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

/// Signed distances to a closed outward mesh at the points of a grid, with linear interpolation
/// between them: a hundred times as fast as the exact distance, with the resolution of the grid.
class SignedGrid {
 public:
  /// `cells`: number of cells along the longest side of the mesh's box, 1 or more. Throws
  /// Error(Cancelled).
  SignedGrid(const IndexedMesh& mesh, int cells, const Execution& execution);

  /// Returns the distance, positive outside; length. Outside the grid, the value at the grid's
  /// nearest point.
  double at(const Vector3& point) const;

  /// Returns the exact distance of a point outside the mesh by the grid; 0 inside; length.
  double distance_outside(const Vector3& point) const;

  double spacing() const { return spacing_; }

 private:
  std::size_t index(int i, int j, int k) const {
    const auto number = [](int value) { return static_cast<std::size_t>(value); };
    return (number(k) * number(counts_[1]) + number(j)) * number(counts_[0]) + number(i);
  }

  MeshDistance distance_;
  Vector3 origin_ = Vector3::Zero();
  double spacing_ = 1.0;
  std::array<int, 3> counts_{};
  std::vector<double> values_;
};

}  // namespace wscvt
