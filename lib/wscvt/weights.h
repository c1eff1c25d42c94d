// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/execution.h"
#include "wscvt/mesh.h"

namespace wscvt {

/// What a seed weighs, and so how large its cell becomes.
enum class Weighting {
  Constant,        ///< equal solid angles
  RadialDistance,  ///< WSCVT-D, eq. 10 as printed: w = S / (N pi r^2)
  Curvature,       ///< WSCVT-C, eqs. 11 to 14: more nodes where curvature is high
  Area,            ///< equal surface areas: w = S / (3.118 N g), g = dA/dOmega
};

/// A relaxed cell's solid angle is this times its seed's weight, plus a constant that is the same
/// for all seeds: 2 / (5 / (9 sqrt 3)) from the second moment of the regular hexagon.
inline constexpr double cell_area_per_weight = 3.118;

/// What the relaxation asks about seeds wherever they stand. One value a seed, in their order.
class SeedModel {
 public:
  virtual ~SeedModel() = default;

  /// Power weights in steradian; left empty when all are equal.
  virtual void weights(const std::vector<Vector3>& seeds, const Execution& execution,
                       std::vector<double>& result) const = 0;

  /// Radii of the surface.
  virtual void radii(const std::vector<Vector3>& seeds, const Execution& execution,
                     std::vector<double>& result) const = 0;

  /// Wanted number of seeds per surface area, any common scale; left empty when it is constant.
  virtual void surface_densities(const std::vector<Vector3>& seeds, const Execution& execution,
                                 std::vector<double>& result) const = 0;
};

}  // namespace wscvt
