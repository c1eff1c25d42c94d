// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt::test {

/// Coefficients of a grain about one unit across, positive, with random harmonics to `degree`.
inline std::vector<double> random_harmonics(int degree, std::uint64_t seed) {
  const std::vector<Vector3> random =
      random_directions(static_cast<int>(harmonic_count(degree)), announced(seed));
  std::vector<double> coefficients;
  for (int l = 0; l <= degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      coefficients.push_back(0.3 * random[coefficients.size()].x() / ((1.0 + l) * (1.0 + l)));
    }
  }
  coefficients[0] = std::sqrt(4.0 * pi);
  return coefficients;
}

}  // namespace wscvt::test
