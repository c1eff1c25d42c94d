// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A relaxed cell's solid angle is this times its seed's weight, plus a constant that is equal for
/// all seeds: 2 / (5 / (9 sqrt 3)) from the second moment of the regular hexagon.
inline constexpr double cell_area_per_weight = 3.118;

/// Smallest cell, as a fraction of the mean cell, for which this law is used; no cell is wanted
/// smaller.
inline constexpr double smallest_cell_share = 0.05;

/// Weights of seeds at any position, for the relaxation. One value per seed, in their order.
class SeedModel {
 public:
  virtual ~SeedModel() = default;

  /// Computes power weights in steradian for the seeds; empty if all are equal.
  virtual void weights(const std::vector<Vector3>& seeds, const Execution& execution,
                       std::vector<double>& result) const = 0;
};

}  // namespace wscvt
