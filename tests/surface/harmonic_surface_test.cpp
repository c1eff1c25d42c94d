// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random_harmonics.h"
#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

const double pi = std::acos(-1.0);

TEST(HarmonicSurface, RefusesBadCoefficients) {
  EXPECT_THROW(HarmonicSurface({}), Error);
  EXPECT_THROW(HarmonicSurface({1.0, 2.0, 3.0}), Error);
  EXPECT_THROW(HarmonicSurface({std::numeric_limits<double>::infinity()}), Error);
  EXPECT_EQ(HarmonicSurface({1.0, 0.0, 0.0, 0.0}).degree(), 1);
}

TEST(HarmonicSurface, GradientEnergyFromCoefficients) {
  // Integral of |grad r|^2 = sum l (l + 1) a_lm^2 (Green), exact under the quadrature.
  const std::vector<double> a = test::random_harmonics(14, 8);
  double expected = 0.0;
  for (int l = 0; l <= 14; ++l) {
    for (int m = -l; m <= l; ++m) expected += l * (l + 1.0) * std::pow(a[harmonic_index(l, m)], 2);
  }
  const SurfaceIntegrals integrals = integrate(HarmonicSurface(a), 45, Execution(1));
  EXPECT_NEAR(integrals.gradient_square, expected, 1e-12 * expected);
}

TEST(HarmonicSurface, JetsAgreeWithRadii) {
  const HarmonicSurface surface(test::random_harmonics(10, 4));
  const std::vector<Vector3> u = random_directions(100, test::announced(12));
  const std::vector<double> radii = surface.radii(u, Execution(2));
  const std::vector<RadialJet> jets = surface.jets(u, Derivatives::Second, Execution(2));
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(radii[i], jets[i].radius);
}

TEST(HarmonicMap, PositionsOfAnAffineImageOfTheSphere) {
  const Vector3 axes(2.0, 1.5, 1.0);
  const Vector3 shift(0.3, -0.2, 0.1);
  const HarmonicMap ellipsoid = test::affine_map(axes, shift);
  const std::vector<Vector3> u = random_directions(3000, test::announced(14));
  const std::vector<Vector3> points = ellipsoid.positions(u, Execution(2));
  for (std::size_t i = 0; i < u.size(); ++i) {
    // A few dozen operations on numbers of size 1.
    EXPECT_LT((points[i] - shift - axes.cwiseProduct(u[i])).norm(), 1e-13);
  }
  EXPECT_EQ(points, ellipsoid.positions(u, Execution(1)));
  EXPECT_EQ(points[17], ellipsoid.positions({u[17]}, Execution(1)).front());
}

}  // namespace
}  // namespace wscvt
