// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
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

/// An ellipsoid as the image of the sphere, x(u) = centre + axes * u by coordinates: a surface over
/// the sphere that is not radial, with closed forms. Lengths.
inline HarmonicMap affine_map(const Vector3& axes, const Vector3& centre = Vector3::Zero()) {
  const double linear = std::sqrt(4.0 * pi / 3.0);  // of a coordinate by the harmonic of degree 1
  std::array<std::vector<double>, 3> coefficients;
  for (std::size_t k = 0; k < 3; ++k) {
    coefficients[k].assign(4, 0.0);
    coefficients[k][0] = centre[static_cast<Eigen::Index>(k)] * std::sqrt(4.0 * pi);
  }
  coefficients[0][harmonic_index(1, 1)] = -axes.x() * linear;
  coefficients[1][harmonic_index(1, -1)] = -axes.y() * linear;
  coefficients[2][harmonic_index(1, 0)] = axes.z() * linear;
  return HarmonicMap(coefficients);
}

}  // namespace wscvt::test
