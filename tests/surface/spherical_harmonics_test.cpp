// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {
namespace {

std::vector<double> random_coefficients(int degree, std::uint64_t seed) {
  const std::vector<Vector3> random =
      random_directions(static_cast<int>(harmonic_count(degree)), test::announced(seed));
  std::vector<double> coefficients;
  coefficients.reserve(random.size());
  for (const Vector3& u : random) coefficients.push_back(u.x());
  return coefficients;
}

std::vector<Vector3> directions_with_poles() {
  std::vector<Vector3> directions = {Vector3::UnitZ(), -Vector3::UnitZ(), Vector3::UnitX(),
                                     -Vector3::UnitY()};
  for (const double tilt : {1e-300, 1e-160, 1e-12, 1e-8, 1e-4, 1e-2}) {
    directions.emplace_back(Vector3(tilt, -0.5 * tilt, 1.0).normalized());
    directions.emplace_back(Vector3(-tilt, tilt, -1.0).normalized());
  }
  for (const Vector3& u : random_directions(20, test::announced(7))) directions.push_back(u);
  return directions;
}

TEST(SphericalHarmonics, ClosedFormsUpToDegreeTwo) {
  const std::vector<Vector3> directions = directions_with_poles();
  const std::vector<double> values = harmonic_values(2, directions.data(), directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double x = directions[i].x();
    const double y = directions[i].y();
    const double z = directions[i].z();
    const double first = std::sqrt(3.0 / (4.0 * pi));
    const double second = std::sqrt(15.0 / (4.0 * pi));
    const double expected[9] = {std::sqrt(1.0 / (4.0 * pi)),
                                -first * y,
                                first * z,
                                -first * x,
                                second * x * y,
                                -second * y * z,
                                std::sqrt(5.0 / (16.0 * pi)) * (3.0 * z * z - 1.0),
                                -second * x * z,
                                0.5 * second * (x * x - y * y)};
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(values[9 * i + k], expected[k], 1e-15);
  }
}

TEST(SphericalHarmonics, OrthonormalUnderQuadratureToDegree60) {
  const int degree = 60;
  const SphereQuadrature quadrature = gauss_legendre_sphere(degree + 1);
  const std::size_t count = quadrature.directions.size();
  const auto width = static_cast<Eigen::Index>(harmonic_count(degree));
  // The whole Gram matrix is large: some harmonics of all and of the last two degrees, against all.
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index k = 0; k < width; k += 211) chosen.push_back(k);
  for (Eigen::Index k = 59 * 59; k < width; k += 29) chosen.push_back(k);
  const auto chosen_count = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(chosen_count, width);
  constexpr std::size_t block = 500;
  for (std::size_t begin = 0; begin < count; begin += block) {
    const std::size_t size = std::min(block, count - begin);
    const auto rows = static_cast<Eigen::Index>(size);
    const std::vector<double> values =
        harmonic_values(degree, quadrature.directions.data() + begin, size);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> basis(values.data(), rows, width);
    const Eigen::Map<const Eigen::VectorXd> weights(quadrature.weights.data() + begin, rows);
    Eigen::MatrixXd left(rows, chosen_count);
    for (Eigen::Index k = 0; k < chosen_count; ++k) {
      left.col(k) = weights.cwiseProduct(basis.col(chosen[static_cast<std::size_t>(k)]));
    }
    gram += left.transpose() * basis;
  }
  for (Eigen::Index k = 0; k < chosen_count; ++k) {
    gram(k, chosen[static_cast<std::size_t>(k)]) -= 1.0;
  }
  // Rounding of recurrences of 60 steps and of sums over 7,442 nodes.
  EXPECT_LT(gram.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SphericalHarmonics, AdditionTheorem) {
  const int degree = 60;
  const std::vector<Vector3> u = directions_with_poles();
  const std::vector<double> values = harmonic_values(degree, u.data(), u.size());
  const std::size_t width = harmonic_count(degree);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::size_t j = (i + 5) % u.size();
    const double t = u[i].dot(u[j]);
    double previous = 1.0;
    double legendre = t;
    for (int l = 1; l <= degree; ++l) {
      double sum = 0.0;
      for (std::size_t k = harmonic_index(l, -l); k <= harmonic_index(l, l); ++k) {
        sum += values[i * width + k] * values[j * width + k];
      }
      // 1e-13 relative to (2l + 1)/(4 pi); P_l' = l(l+1)/2 at t = 1 amplifies the rounding of t.
      EXPECT_NEAR(sum * 4.0 * pi / (2 * l + 1), legendre, 1e-12) << "degree " << l;
      const double next = ((2.0 * l + 1.0) * t * legendre - l * previous) / (l + 1.0);
      previous = legendre;
      legendre = next;
    }
  }
}

TEST(SphericalHarmonics, SeriesAgreesWithBasisAndWithLegendreForm) {
  const int degree = 60;
  const std::vector<double> a = random_coefficients(degree, 3);
  const std::vector<Vector3> u = directions_with_poles();
  const std::vector<double> values = harmonic_values(degree, u.data(), u.size());
  std::vector<double> sums(u.size());
  HarmonicSeries(a).sum(u.data(), u.size(), sums.data());
  for (std::size_t i = 0; i < u.size(); ++i) {
    double expected = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) expected += a[k] * values[i * a.size() + k];
    EXPECT_NEAR(sums[i], expected, 1e-11);
    const double sine = std::hypot(u[i].x(), u[i].y());
    const double azimuth = std::atan2(u[i].y(), u[i].x());
    double trigonometric = 0.0;
    std::vector<double> legendre(static_cast<std::size_t>(degree) + 1);
    for (int m = 0; m <= degree; ++m) {
      associated_legendre(degree, m, &u[i].z(), &sine, 1, legendre.data());
      for (int l = m; l <= degree; ++l) {
        const double p = legendre[static_cast<std::size_t>(l - m)];
        trigonometric += a[harmonic_index(l, m)] * p * std::cos(m * azimuth);
        if (m > 0) trigonometric += a[harmonic_index(l, -m)] * p * std::sin(m * azimuth);
      }
    }
    EXPECT_NEAR(trigonometric, expected, 1e-11);
  }
}

TEST(SphericalHarmonics, DerivativesAgreeWithFiniteDifferencesAlsoAtThePoles) {
  const int degree = 20;
  const std::vector<double> a = random_coefficients(degree, 11);
  const HarmonicSeries series(a);
  const auto extended = [&](const Vector3& x) {
    const Vector3 u = x.normalized();
    double value = 0.0;
    series.sum(&u, 1, &value);
    return value;
  };
  const std::vector<Vector3> u = directions_with_poles();
  std::vector<RadialJet> jets(u.size());
  series.sum(u.data(), u.size(), Derivatives::Second, jets.data());
  std::vector<RadialJet> first(u.size());
  series.sum(u.data(), u.size(), Derivatives::First, first.data());
  const double step = 1e-3;
  for (std::size_t i = 0; i < u.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_NEAR((jets[i].gradient - first[i].gradient).norm(), 0.0, 1e-12);
    EXPECT_EQ(first[i].hessian, Matrix3(Matrix3::Zero()));
    EXPECT_NEAR(jets[i].gradient.dot(u[i]), 0.0, 1e-11);
    EXPECT_NEAR((jets[i].hessian * u[i] + jets[i].gradient).norm(), 0.0, 1e-9);
    for (int p = 0; p < 3; ++p) {
      const Vector3 ep = step * Vector3::Unit(p);
      const double slope = (8.0 * (extended(u[i] + ep) - extended(u[i] - ep)) -
                            (extended(u[i] + 2 * ep) - extended(u[i] - 2 * ep))) /
                           (12.0 * step);
      // Fourth-order differences: step^4 degree^5 / 30 = 1e-7 of the values (about 10), a degree
      // more for the second derivatives.
      EXPECT_NEAR(slope, jets[i].gradient[p], 1e-5);
      for (int q = 0; q < 3; ++q) {
        const auto slope_at = [&](const Vector3& x) {
          const Vector3 v = x.normalized();
          RadialJet jet;
          series.sum(&v, 1, Derivatives::First, &jet);
          return jet.gradient[q] / x.norm();
        };
        const double second = (8.0 * (slope_at(u[i] + ep) - slope_at(u[i] - ep)) -
                               (slope_at(u[i] + 2 * ep) - slope_at(u[i] - 2 * ep))) /
                              (12.0 * step);
        EXPECT_NEAR(second, jets[i].hessian(p, q), 2e-4);
      }
    }
  }
}

TEST(SphericalHarmonics, SurfaceLaplacianIsTheTraceOfTheHessian) {
  // Lap Y_lm = -l(l+1) Y_lm: exact for every degree, so it reaches where differences do not.
  const int degree = 60;
  const std::vector<Vector3> u = directions_with_poles();
  const std::vector<double> a = random_coefficients(degree, 5);
  std::vector<double> laplacian = a;
  for (int l = 0; l <= degree; ++l) {
    for (int m = -l; m <= l; ++m) laplacian[harmonic_index(l, m)] *= -l * (l + 1.0);
  }
  std::vector<RadialJet> jets(u.size());
  HarmonicSeries(a).sum(u.data(), u.size(), Derivatives::Second, jets.data());
  std::vector<double> expected(u.size());
  HarmonicSeries(laplacian).sum(u.data(), u.size(), expected.data());
  for (std::size_t i = 0; i < u.size(); ++i) {
    // The extension's own second derivatives reach degree^4 times the value.
    EXPECT_NEAR(jets[i].hessian.trace(), expected[i], 1e-6) << i;
  }
}

TEST(SphericalHarmonics, ValueDoesNotDependOnTheOtherDirections) {
  const HarmonicSeries series(random_coefficients(13, 2));
  // Those of a grid's row have a part in common, which is summed once.
  std::vector<Vector3> u = SphereGrid::directions(12);
  const std::vector<Vector3> random = random_directions(37, test::announced(4));
  u.insert(u.end(), random.begin(), random.end());
  std::vector<RadialJet> together(u.size());
  series.sum(u.data(), u.size(), Derivatives::Second, together.data());
  std::vector<double> values(u.size());
  series.sum(u.data(), u.size(), values.data());
  for (std::size_t i = 0; i < u.size(); ++i) {
    RadialJet alone;
    series.sum(&u[i], 1, Derivatives::Second, &alone);
    EXPECT_EQ(alone.radius, together[i].radius);
    EXPECT_EQ(alone.gradient, together[i].gradient);
    EXPECT_EQ(alone.hessian, together[i].hessian);
    EXPECT_EQ(values[i], together[i].radius);
  }
}

TEST(SphericalHarmonics, RefusesWhatIsNotASeries) {
  EXPECT_ERROR(HarmonicSeries({}), InvalidInput);
  EXPECT_ERROR(HarmonicSeries({1.0, 2.0}), InvalidInput);
  EXPECT_ERROR(harmonic_values(-1, nullptr, 0), InvalidInput);
  EXPECT_ERROR(harmonic_values(maximum_harmonic_degree + 1, nullptr, 0), InvalidInput);
  const double half = 0.5;
  double value = 0.0;
  EXPECT_ERROR(associated_legendre(2, 3, &half, &half, 1, &value), InvalidInput);
}

}  // namespace
}  // namespace wscvt
