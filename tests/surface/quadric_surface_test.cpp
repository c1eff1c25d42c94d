// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/quadric_surface.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <memory>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/grain_surface.h"

namespace wscvt {
namespace {

std::vector<Vector3> axes_and_random() {
  std::vector<Vector3> u = random_directions(200, test::announced(6));
  for (int i = 0; i < 3; ++i) {
    u.emplace_back(Vector3::Unit(i));
    u.emplace_back(-Vector3::Unit(i));
  }
  u.emplace_back(Vector3(0.6, 0.8, 0.0));
  u.emplace_back(Vector3(0.0, -0.6, 0.8));
  return u;
}

void expect_derivatives_agree_with_differences(const RadialSurface& surface,
                                               const std::vector<Vector3>& directions) {
  const double step = 1e-3;
  const auto radius = [&](const Vector3& x) { return surface.radius(x.normalized()); };
  const auto slope = [&](const Vector3& x, int q) {
    const Vector3 u = x.normalized();
    RadialJet jet;
    surface.evaluate(&u, 1, Derivatives::First, &jet);
    return jet.gradient[q] / x.norm();
  };
  std::vector<RadialJet> jets(directions.size());
  surface.evaluate(directions.data(), directions.size(), Derivatives::Second, jets.data());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vector3& u = directions[i];
    SCOPED_TRACE(u.transpose());
    for (int p = 0; p < 3; ++p) {
      const Vector3 e = step * Vector3::Unit(p);
      const auto difference = [&](const auto& f) {
        return (8.0 * (f(u + e) - f(u - e)) - (f(u + 2 * e) - f(u - 2 * e))) / (12.0 * step);
      };
      // step^4 / 30 times fifth derivatives, which reach some 1e4 for rounded boxes.
      EXPECT_NEAR(difference(radius), jets[i].gradient[p], 1e-7);
      for (int q = 0; q < 3; ++q) {
        EXPECT_NEAR(difference([&](const Vector3& x) { return slope(x, q); }),
                    jets[i].hessian(p, q), 1e-5);
      }
    }
  }
}

TEST(Ellipsoid, DerivativesAgreeWithDifferences) {
  expect_derivatives_agree_with_differences(Ellipsoid({1.0, 0.7, 0.5}), axes_and_random());
}

TEST(Ellipsoid, CurvaturesAgreeWithClosedForm) {
  const Vector3 axes(2.0, 1.1, 0.6);
  const Ellipsoid ellipsoid(axes);
  const std::vector<Vector3> directions = axes_and_random();
  const std::vector<RadialJet> jets = ellipsoid.jets(directions, Derivatives::Second, Execution(1));
  const Vector3 square = axes.cwiseAbs2();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vector3 x = jets[i].radius * directions[i];
    EXPECT_NEAR(x.cwiseQuotient(axes).norm(), 1.0, 1e-14);
    // K = 1/((abc)^2 s^2), H = (a^2 + b^2 + c^2 - |x|^2)/(2 (abc)^2 s^(3/2)), s = sum x_i^2/a_i^4.
    const double s = x.cwiseQuotient(square).squaredNorm();
    const double volume_square = square.prod();
    const double gauss = 1.0 / (volume_square * s * s);
    const double mean = (square.sum() - x.squaredNorm()) / (2.0 * volume_square * std::pow(s, 1.5));
    const PrincipalCurvatures k = principal_curvatures(jets[i], directions[i]);
    EXPECT_NEAR(k.maximum * k.minimum, gauss, 1e-12 * gauss);
    EXPECT_NEAR(0.5 * (k.maximum + k.minimum), mean, 1e-12 * mean);
    const Vector3 normal = x.cwiseQuotient(square).normalized();
    EXPECT_NEAR((surface_normal(jets[i], directions[i]) - normal).norm(), 0.0, 1e-13);
  }
}

TEST(Ellipsoid, VolumeAndAreaAgreeWithClosedForms) {
  // Prolate spheroid: A = 2 pi a^2 (1 + c/(a e) asin e), e^2 = 1 - a^2/c^2.
  const double a = 0.5;
  const double c = 1.0;
  const double e = std::sqrt(1.0 - a * a / (c * c));
  const double area = 2.0 * pi * a * a * (1.0 + c / (a * e) * std::asin(e));
  for (const Vector3& axes : {Vector3(a, a, c), Vector3(c, a, a), Vector3(a, c, a)}) {
    const SurfaceIntegrals integrals = integrate(Ellipsoid(axes), 80, Execution(1));
    EXPECT_NEAR(integrals.volume, 4.0 / 3.0 * pi * axes.prod(), 1e-12);
    EXPECT_NEAR(integrals.area, area, 1e-12);
    EXPECT_NEAR(integrals.centroid.norm(), 0.0, 1e-13);
  }
}

TEST(Ellipsoid, SphereInAnyUnit) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const Ellipsoid sphere(Vector3::Constant(scale));
    const Vector3 u = Vector3(0.3, -0.4, 0.5).normalized();
    RadialJet jet;
    sphere.evaluate(&u, 1, Derivatives::Second, &jet);
    EXPECT_NEAR(jet.radius / scale, 1.0, 1e-15);
    EXPECT_NEAR(jet.gradient.norm() / scale, 0.0, 1e-15);
    EXPECT_NEAR(jet.hessian.norm() / scale, 0.0, 1e-14);
  }
}

TEST(Superellipsoid, UnitExponentsGiveTheEllipsoid) {
  const Vector3 axes(1.0, 0.7, 0.5);
  const std::vector<Vector3> u = axes_and_random();
  const auto jets = Superellipsoid(axes, 1.0, 1.0).jets(u, Derivatives::Second, Execution(1));
  const auto expected = Ellipsoid(axes).jets(u, Derivatives::Second, Execution(1));
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_NEAR(jets[i].radius, expected[i].radius, 1e-15);
    EXPECT_NEAR((jets[i].gradient - expected[i].gradient).norm(), 0.0, 1e-14);
    EXPECT_NEAR((jets[i].hessian - expected[i].hessian).norm(), 0.0, 1e-13);
  }
}

TEST(Superellipsoid, EqualExponentsGiveASumOfPowers) {
  const Vector3 axes(1.0, 0.8, 0.65);
  const double q = 2.0 / 0.4;
  const Superellipsoid surface(axes, 0.4, 0.4);
  for (const Vector3& u : axes_and_random()) {
    const Vector3 x = surface.radius(u) * u.cwiseQuotient(axes);
    EXPECT_NEAR(x.cwiseAbs().array().pow(q).sum(), 1.0, 1e-13);
  }
}

TEST(Superellipsoid, DerivativesAgreeWithDifferences) {
  expect_derivatives_agree_with_differences(Superellipsoid({1.0, 0.8, 0.65}, 0.4, 0.4),
                                            axes_and_random());
  expect_derivatives_agree_with_differences(Superellipsoid({1.0, 1.2, 0.9}, 0.5, 0.4),
                                            random_directions(100, test::announced(3)));
}

TEST(Superellipsoid, VolumeAgreesWithClosedForm) {
  // V = 2 a b c e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2) (Jaklic, Leonardis, Solina 2000, eq. 2.60).
  const auto beta = [](double x, double y) {
    return std::exp(std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y));
  };
  for (const auto& [e1, e2] : {std::pair(0.4, 0.4), std::pair(1.0, 0.5), std::pair(0.5, 1.0)}) {
    const Vector3 axes(1.0, 0.8, 0.65);
    const double expected =
        2.0 * axes.prod() * e1 * e2 * beta(0.5 * e1 + 1.0, e1) * beta(0.5 * e2, 0.5 * e2);
    const SurfaceIntegrals integrals = integrate(Superellipsoid(axes, e1, e2), 120, Execution(1));
    // Powers of |x| limit the order of the quadrature: 120^-5.
    EXPECT_NEAR(integrals.volume, expected, 1e-7);
  }
}

TEST(Superellipsoid, JetsAreFiniteAndTangentialEverywhere) {
  for (const double e1 : {0.1, 0.4, 1.0, 1.5, 2.0}) {
    for (const double e2 : {0.1, 0.4, 1.0, 1.5, 2.0}) {
      for (const double scale : {1e-9, 1.0, 1e9}) {
        const Superellipsoid surface(scale * Vector3(1.0, 0.8, 0.65), e1, e2);
        for (const Vector3& u : axes_and_random()) {
          RadialJet jet;
          surface.evaluate(&u, 1, Derivatives::Second, &jet);
          SCOPED_TRACE(testing::Message() << e1 << ' ' << e2 << ' ' << u.transpose());
          ASSERT_GT(jet.radius, 0.4 * scale * 0.65);
          ASSERT_LT(jet.radius, 1.8 * scale);
          ASSERT_TRUE(jet.gradient.allFinite());
          ASSERT_TRUE(jet.hessian.allFinite());
          ASSERT_LT(std::abs(jet.gradient.dot(u)), 1e-12 * scale);
        }
      }
    }
  }
}

TEST(QuadricSurfaces, FillOnlyWhatIsAskedFor) {
  const Vector3 u = Vector3(0.3, -0.4, 0.5).normalized();
  const std::unique_ptr<RadialSurface> surfaces[] = {
      std::make_unique<Ellipsoid>(Vector3(1.0, 0.7, 0.5)),
      std::make_unique<Superellipsoid>(Vector3(1.0, 0.7, 0.5), 0.5, 0.5)};
  for (const auto& surface : surfaces) {
    RadialJet jet;
    surface->evaluate(&u, 1, Derivatives::None, &jet);
    EXPECT_GT(jet.radius, 0.0);
    EXPECT_EQ(jet.gradient.norm(), 0.0);
    surface->evaluate(&u, 1, Derivatives::First, &jet);
    EXPECT_GT(jet.gradient.norm(), 0.0);
    EXPECT_EQ(jet.hessian.norm(), 0.0);
  }
}

TEST(QuadricSurfaces, RefuseBadParameters) {
  EXPECT_ERROR(Ellipsoid({1.0, 0.0, 1.0}), InvalidInput);
  EXPECT_ERROR(Ellipsoid({1.0, std::numeric_limits<double>::quiet_NaN(), 1.0}), InvalidInput);
  EXPECT_ERROR(Superellipsoid({1.0, 1.0, -1.0}, 1.0, 1.0), InvalidInput);
  EXPECT_ERROR(Superellipsoid({1.0, 1.0, 1.0}, 0.05, 1.0), InvalidInput);
  EXPECT_ERROR(Superellipsoid({1.0, 1.0, 1.0}, 1.0, 2.5), InvalidInput);
}

TEST(GrainSurface, IsNamedByItsKindOrFile) {
  GrainSurface surface;
  EXPECT_EQ(surface_name(surface), "Ellipsoid");
  surface.kind = SurfaceKind::Superellipsoid;
  EXPECT_EQ(surface_name(surface), "Superellipsoid");
  surface.kind = SurfaceKind::Harmonics;
  surface.coefficients_file = "folder/grain.DAT";
  EXPECT_EQ(surface_name(surface), "grain");
}

TEST(GrainSurface, RefusesWhatIsOutOfRange) {
  const auto refused = [](const auto& change) {
    GrainSurface surface;
    change(surface);
    EXPECT_ERROR(check_grain_surface(surface), InvalidInput);
  };
  EXPECT_NO_THROW(check_grain_surface(GrainSurface()));
  refused([](GrainSurface& one) { one.semi_axes.y() = 0.0; });
  refused([](GrainSurface& one) { one.semi_axes.z() = std::numeric_limits<double>::quiet_NaN(); });
  refused([](GrainSurface& one) { one.polar_exponent = 2.1; });
  refused([](GrainSurface& one) { one.azimuthal_exponent = 0.0; });
  refused([](GrainSurface& one) { one.coefficient_degree = -2; });
  refused([](GrainSurface& one) { one.kind = static_cast<SurfaceKind>(3); });
  refused([](GrainSurface& one) { one.kind = SurfaceKind::Harmonics; });
  refused([](GrainSurface& one) {
    one.kind = SurfaceKind::Harmonics;
    one.coefficients_file = "grain.ply";
  });
}

}  // namespace

}  // namespace wscvt
