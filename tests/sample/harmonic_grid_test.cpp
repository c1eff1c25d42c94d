// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/harmonic_grid.h"

#include <gtest/gtest.h>

#include "support/random_harmonics.h"

namespace wscvt {
namespace {

TEST(HarmonicGrid, FindsTheCoefficientsOfItsValues) {
  const HarmonicGrid grid(9, 12);
  const std::vector<double> series = test::random_harmonics(9, 3);
  const std::vector<double> values = grid.values(series);
  const HarmonicSurface surface(series);
  double sum = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_NEAR(values[k], surface.radius(grid.directions()[k]), 1e-12);
    sum += grid.weights()[k];
  }
  EXPECT_NEAR(sum, 4.0 * pi, 1e-12);
  const std::vector<double> found = grid.coefficients(values);
  for (std::size_t k = 0; k < series.size(); ++k) EXPECT_NEAR(found[k], series[k], 1e-12);
}

TEST(HarmonicGrid, MirrorsASeriesAsItsDirections) {
  const std::vector<double> series = test::random_harmonics(7, 5);
  const HarmonicSurface surface(series);
  for (int bits = 0; bits < 8; ++bits) {
    const Vector3 signs((bits & 1) != 0 ? -1 : 1, (bits & 2) != 0 ? -1 : 1,
                        (bits & 4) != 0 ? -1 : 1);
    const HarmonicSurface image(mirrored(series, signs));
    for (const Vector3& u : random_directions(20, 9)) {
      EXPECT_NEAR(image.radius(u), surface.radius(signs.cwiseProduct(u)), 1e-13);
    }
  }
}

// An ellipsoid off the origin, whose moments are known.
TEST(HarmonicGrid, TakesTheMomentsOfASolid) {
  const HarmonicGrid grid(4, 60);
  const Vector3 axes(1.3, 1.1, 0.8), centre(0.1, -0.2, 0.05);
  std::vector<double> radii;
  for (const Vector3& u : grid.directions()) {
    const Vector3 a = u.cwiseQuotient(axes), c = centre.cwiseQuotient(axes);
    const double half = a.dot(c);
    radii.push_back((half + std::sqrt(half * half - a.dot(a) * (c.dot(c) - 1.0))) / a.dot(a));
  }
  const RadialMoments moments = radial_moments(grid, radii);
  EXPECT_NEAR(moments.volume, 4.0 * pi / 3.0 * axes.prod(), 1e-9);
  EXPECT_LT((moments.centroid - centre).norm(), 1e-9);
  const Eigen::Matrix3d expected = (axes.cwiseAbs2() / 5.0).asDiagonal();
  EXPECT_LT((moments.covariance - expected).norm(), 1e-9);
}

TEST(HarmonicGrid, AmplitudesAreTheRootsOfTheSquaresOfADegree) {
  const std::vector<double> amplitudes = degree_amplitudes({-2, 1, 2, 2, 3, 0, 0, 4, 0});
  EXPECT_EQ(amplitudes, (std::vector<double>{2, 3, 5}));
}

}  // namespace
}  // namespace wscvt
