// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/roundness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/affine_map.h"
#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

TEST(Roundness, SphereIsRound) {
  const Roundness r = wadell_roundness(Ellipsoid({2, 2, 2}), 2.0, 16, Execution(1));
  EXPECT_NEAR(r.roundness, 1.0, 1e-12);
}

TEST(Roundness, NoCornersWithoutCurvatureAboveTheInscribedSpheres) {
  const Roundness r = wadell_roundness(Ellipsoid({2, 2, 2}), 1.0, 16, Execution(1));
  EXPECT_EQ(r.roundness, 1.0);
  EXPECT_EQ(r.corner_area_share, 0.0);
}

/// By the ellipsoid's own parameters, x = (a sin t cos p, b sin t sin p, c cos t), and the textbook
/// curvatures: with h = 1 / |x / a^2|, K = h^4 / (a b c)^2 and
/// H = h^3 (a^2 + b^2 + c^2 - |x|^2) / (2 (a b c)^2).
Roundness ellipsoid_roundness(const Vector3& axes, double inscribed_radius) {
  const double product = axes.prod();
  double area = 0.0;
  double corners = 0.0;
  double radii = 0.0;
  const int n = 1000;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double t = (i + 0.5) * test::pi / n;
      const double p = (j + 0.5) * 2.0 * test::pi / n;
      const Vector3 u(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
      const Vector3 x = axes.cwiseProduct(u);
      const double h = 1.0 / u.cwiseQuotient(axes).norm();
      const double part = product / h * std::sin(t);
      const double gauss = std::pow(h, 4) / (product * product);
      const double mean =
          std::pow(h, 3) * (axes.squaredNorm() - x.squaredNorm()) / (2.0 * product * product);
      const double k = mean + std::sqrt(std::max(0.0, mean * mean - gauss));
      area += part;
      if (k * inscribed_radius > 1.0) {
        corners += part;
        radii += part / k;
      }
    }
  }
  return {radii / (corners * inscribed_radius), corners / area};
}

TEST(Roundness, DoesNotHangOnHowTheSurfaceIsLaidOverTheSphere) {
  const Vector3 axes(0.5, 0.7, 1.0);
  const Roundness expected = ellipsoid_roundness(axes, 0.5);
  const Roundness r = wadell_roundness(test::affine_map(axes), 0.5, 128, Execution(1));
  // The edge of the corners crosses the quadrature's cells, 256 x 128 of them.
  EXPECT_NEAR(r.roundness, expected.roundness, 2e-3);
  EXPECT_NEAR(r.corner_area_share, expected.corner_area_share, 5e-3);
}

TEST(Roundness, EllipsoidAgreesWithItsTextbookCurvatures) {
  const Vector3 axes(0.5, 0.7, 1.0);
  const Roundness expected = ellipsoid_roundness(axes, 0.5);
  for (const Vector3& turned : {axes, Vector3(1.0, 0.5, 0.7), Vector3(0.7, 1.0, 0.5)}) {
    SCOPED_TRACE(::testing::Message() << "axes " << turned.transpose());
    const Roundness r = wadell_roundness(Ellipsoid(turned), 0.5, 128, Execution(1));
    // The edge of the corners runs between the quadrature's nodes.
    EXPECT_NEAR(r.roundness, expected.roundness, 3e-3);
    EXPECT_NEAR(r.corner_area_share, expected.corner_area_share, 5e-3);
  }
  EXPECT_LT(expected.roundness, 1.0);
}

TEST(Roundness, DoesNotDependOnScale) {
  const Roundness one = wadell_roundness(Ellipsoid({1, 2, 3}), 1.0, 64, Execution(1));
  const Roundness small = wadell_roundness(Ellipsoid({1e-6, 2e-6, 3e-6}), 1e-6, 64, Execution(2));
  EXPECT_NEAR(one.roundness, small.roundness, 1e-9);
  EXPECT_NEAR(one.corner_area_share, small.corner_area_share, 1e-9);
}

TEST(Roundness, RefusesARadiusThatIsNotPositive) {
  const Ellipsoid surface({1, 1, 1});
  EXPECT_ERROR(wadell_roundness(surface, 0.0, 16, Execution(1)), InvalidInput);
  EXPECT_ERROR(wadell_roundness(surface, 1.0, 0, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
