// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/expect_error.h"
#include "support/plain_fit.h"
#include "support/seeds.h"
#include "wscvt/base/pi.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

/// A grain about one unit across, positive, with harmonics to `degree`.
std::vector<double> grain_coefficients(int degree, std::uint64_t seed) {
  const std::vector<Vector3> random =
      random_directions(static_cast<int>(harmonic_count(degree)), test::announced(seed));
  std::vector<double> coefficients;
  for (int l = 0; l <= degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      coefficients.push_back(0.3 * random[coefficients.size()].x() / ((1.0 + l) * (1.0 + l)));
    }
  }
  coefficients[0] = std::sqrt(4.0 * pi);
  return coefficients;
}

struct TestSamples {
  std::vector<Vector3> directions;
  std::vector<double> radii;
  std::vector<double> weights;
};

/// Random directions, noise, and weights between 0.1 and 2.7.
TestSamples noisy_samples(int count, int degree, double noise) {
  TestSamples samples;
  samples.directions = random_directions(count, test::announced(5));
  const std::vector<Vector3> random = random_directions(count, test::announced(9));
  samples.radii =
      HarmonicSurface(grain_coefficients(degree, 3)).radii(samples.directions, Execution(1));
  for (std::size_t i = 0; i < random.size(); ++i) {
    samples.radii[i] += noise * random[i].z();
    samples.weights.push_back(1.4 + 0.8 * samples.directions[i].z() + 0.5 * random[i].x());
  }
  return samples;
}

HarmonicFit fit(const TestSamples& samples, int degree, int threads = 1) {
  return fit_harmonics(samples.directions, samples.radii, samples.weights, degree,
                       Execution(threads));
}

TEST(HarmonicFit, SpreadPointsAgreeWithPlainLeastSquares) {
  // Harmonics beyond the fitted degree make a residual that is not white.
  const TestSamples samples = noisy_samples(6000, 20, 2e-3);
  const HarmonicFit result = fit(samples, 14);
  const test::PlainFit plain =
      test::plain_least_squares(samples.directions, samples.radii, samples.weights, 14);
  EXPECT_EQ(result.report.degree, 14);
  EXPECT_EQ(result.report.points, samples.radii.size());
  // Required is 1e-3 of the residual; measured is 4e-6.
  EXPECT_LT(test::rms_difference(result.surface.coefficients(), plain.coefficients),
            1e-4 * plain.residual);
  EXPECT_NEAR(result.report.residual, plain.residual, 1e-6 * plain.residual);
  EXPECT_GT(result.report.residual, 1e-4);
}

TEST(HarmonicFit, SpreadPointsAgreeWithPlainLeastSquaresForUnevenWeights) {
  // One point in twenty weighs a hundred times as much as the others. What the grid loses of the
  // weights' moments then shows: 1e-3 to 2e-3 of the residual in one pass, 3e-6 to 2e-5 in two.
  TestSamples samples = noisy_samples(6000, 12, 2e-3);
  for (std::size_t i = 0; i < samples.weights.size(); ++i) {
    samples.weights[i] = i % 20 == 0 ? 100.0 : 1.0;
  }
  for (const int degree : {8, 14}) {
    SCOPED_TRACE(degree);
    const HarmonicFit result = fit(samples, degree);
    const test::PlainFit plain =
        test::plain_least_squares(samples.directions, samples.radii, samples.weights, degree);
    EXPECT_EQ(result.report.degree, degree);
    EXPECT_LT(test::rms_difference(result.surface.coefficients(), plain.coefficients),
              1e-4 * plain.residual);
  }
}

TEST(HarmonicFit, StoredPointsAgreeWithPlainLeastSquares) {
  const TestSamples samples = noisy_samples(900, 12, 2e-3);
  const HarmonicFit result = fit(samples, 10);
  const test::PlainFit plain =
      test::plain_least_squares(samples.directions, samples.radii, samples.weights, 10);
  EXPECT_EQ(result.report.degree, 10);
  EXPECT_LT(test::rms_difference(result.surface.coefficients(), plain.coefficients),
            1e-9 * plain.residual);
  EXPECT_NEAR(result.report.residual, plain.residual, 1e-9 * plain.residual);
}

TEST(HarmonicFit, ConditionIsThatOfTheNormalMatrix) {
  const TestSamples samples = noisy_samples(1000, 6, 0.0);
  const HarmonicFit result = fit(samples, 6);
  const std::vector<double> values =
      harmonic_values(6, samples.directions.data(), samples.directions.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> basis(values.data(), 1000, 49);
  const Eigen::Map<const Eigen::VectorXd> weights(samples.weights.data(), 1000);
  const Eigen::VectorXd singular =
      (weights.cwiseSqrt().asDiagonal() * basis).eval().jacobiSvd().singularValues();
  const double condition = std::pow(singular[0] / singular[48], 2);
  // Ritz values lie inside the spectrum; stopping at 1e-4 leaves them a few per cent short.
  EXPECT_LE(result.report.condition, condition * (1.0 + 1e-9));
  EXPECT_GE(result.report.condition, 0.9 * condition);
}

TEST(HarmonicFit, RecoversABandLimitedSurface) {
  for (const int count : {1200, 20000}) {
    SCOPED_TRACE(count);
    const TestSamples samples = noisy_samples(count, 12, 0.0);
    const HarmonicFit result = fit(samples, 12);
    const std::vector<double> expected = grain_coefficients(12, 3);
    const Eigen::Map<const Eigen::VectorXd> mapped(expected.data(),
                                                   static_cast<Eigen::Index>(expected.size()));
    // The grid's interpolation errs by 2e-5 of the highest harmonics, themselves 1e-2 of the
    // radius.
    EXPECT_LT(test::rms_difference(result.surface.coefficients(), mapped),
              count > 2000 ? 1e-7 : 1e-12);
    EXPECT_LT(result.report.residual, count > 2000 ? 1e-6 : 1e-12);
  }
}

TEST(HarmonicFit, EnergyPerDegreeIsInvariantUnderRotation) {
  const TestSamples samples = noisy_samples(20000, 15, 1e-3);
  TestSamples rotated = samples;
  const Eigen::AngleAxisd rotation(1.1, Vector3(0.3, -0.8, 0.5).normalized());
  for (Vector3& u : rotated.directions) u = (rotation * u).normalized();
  const HarmonicFit first = fit(samples, 12);
  const HarmonicFit second = fit(rotated, 12);
  const auto energy = [](const HarmonicFit& result, int l) {
    double sum = 0.0;
    for (int m = -l; m <= l; ++m) {
      sum += std::pow(result.surface.coefficients()[harmonic_index(l, m)], 2);
    }
    return sum;
  };
  for (int l = 0; l <= 12; ++l) {
    // The two runs spread the points to differently lying grids: 4e-6 of the residual, 2e-3.
    EXPECT_NEAR(std::sqrt(energy(first, l)), std::sqrt(energy(second, l)), 1e-7) << l;
  }
  EXPECT_NEAR(first.report.residual, second.report.residual, 1e-6 * first.report.residual);
}

TEST(HarmonicFit, ScalesWithTheLengthUnit) {
  for (const int count : {800, 5000}) {
    const TestSamples samples = noisy_samples(count, 9, 1e-3);
    const HarmonicFit reference = fit(samples, 9);
    for (const double scale : {1e-6, 1e6}) {
      SCOPED_TRACE(scale);
      TestSamples scaled = samples;
      for (double& radius : scaled.radii) radius *= scale;
      for (double& weight : scaled.weights) weight *= 1.0 / scale;
      const HarmonicFit result = fit(scaled, 9);
      for (std::size_t k = 0; k < reference.surface.coefficients().size(); ++k) {
        EXPECT_NEAR(result.surface.coefficients()[k] / scale, reference.surface.coefficients()[k],
                    1e-12);
      }
      EXPECT_NEAR(result.report.residual / scale, reference.report.residual, 1e-12);
    }
  }
}

TEST(HarmonicFit, SphereGivesASphere) {
  TestSamples samples = noisy_samples(3000, 0, 0.0);
  for (double& radius : samples.radii) radius = 2.5;
  const HarmonicFit result = fit(samples, 20);
  EXPECT_EQ(result.report.degree, 20);
  EXPECT_NEAR(result.report.smallest_radius, 2.5, 1e-12);
  EXPECT_NEAR(result.surface.radius(Vector3::UnitX()), 2.5, 1e-12);
  EXPECT_LT(result.report.residual, 1e-12);
}

TEST(HarmonicFit, LowersTheDegreeWhenPointsAreFew) {
  TestSamples samples = noisy_samples(1, 0, 0.0);
  EXPECT_EQ(fit(samples, 20).report.degree, 0);
  samples = noisy_samples(4, 0, 0.0);
  EXPECT_EQ(fit(samples, 20).report.degree, 0);
  // 230 lattice points, so evenly spread that only their number counts: (9 + 1)^2 <= 115.
  samples.directions = fibonacci_lattice(230);
  samples.weights.assign(230, 1.0);
  samples.radii = HarmonicSurface(grain_coefficients(9, 3)).radii(samples.directions, Execution(1));
  const HarmonicFit result = fit(samples, 20);
  EXPECT_EQ(result.report.requested_degree, 20);
  EXPECT_EQ(result.report.degree, 9);
  EXPECT_EQ(result.report.limit, DegreeLimit::Points);
  EXPECT_LT(result.report.residual, 1e-12);
  EXPECT_EQ(fit(samples, 9).report.limit, DegreeLimit::None);
}

TEST(HarmonicFit, LowersTheDegreeWhenPartOfTheSphereIsBare) {
  TestSamples all = noisy_samples(5000, 6, 0.0);
  for (const std::size_t limit : {std::size_t{600}, std::size_t{3000}}) {
    TestSamples samples;
    for (std::size_t i = 0; i < all.radii.size() && samples.radii.size() < limit; ++i) {
      if (all.directions[i].z() > 0.7) continue;
      samples.directions.push_back(all.directions[i]);
      samples.radii.push_back(all.radii[i]);
      samples.weights.push_back(1.0);
    }
    const HarmonicFit result = fit(samples, 12);
    EXPECT_LT(result.report.degree, 12);
    EXPECT_GT(result.report.degree, 0);
    EXPECT_EQ(result.report.limit, DegreeLimit::Condition);
    EXPECT_LE(result.report.condition, 1000.0);
    EXPECT_GT(result.report.smallest_radius, 0.0);
  }
}

TEST(HarmonicFit, SameBytesOnAnyNumberOfThreads) {
  const TestSamples samples = noisy_samples(150000, 12, 1e-3);
  const HarmonicFit one = fit(samples, 10, 1);
  for (const int threads : {2, 5}) {
    const HarmonicFit many = fit(samples, 10, threads);
    EXPECT_EQ(one.surface.coefficients(), many.surface.coefficients());
    EXPECT_EQ(one.report.residual, many.report.residual);
  }
}

TEST(HarmonicFit, RefusesBadInput) {
  TestSamples samples = noisy_samples(50, 2, 0.0);
  const auto expect_refused = [](const TestSamples& bad, int degree) {
    test::expect_error(ErrorCode::InvalidInput, [&] { fit(bad, degree); });
  };
  expect_refused(samples, -1);
  expect_refused(samples, 61);
  expect_refused(TestSamples{}, 2);
  const auto expect_broken = [&](const auto& change) {
    TestSamples copy = samples;
    change(copy);
    expect_refused(copy, 2);
  };
  expect_broken([](TestSamples& s) { s.radii.pop_back(); });
  expect_broken([](TestSamples& s) { s.weights.push_back(1.0); });
  expect_broken([](TestSamples& s) { s.radii[3] = 0.0; });
  expect_broken([](TestSamples& s) { s.weights[3] = -1.0; });
  expect_broken([](TestSamples& s) { s.directions[3] *= 2.0; });
  expect_broken([](TestSamples& s) { s.radii[3] = std::numeric_limits<double>::quiet_NaN(); });
}

TEST(HarmonicSurface, RefusesBadCoefficients) {
  const auto expect_refused = [](const std::vector<double>& coefficients) {
    test::expect_error(ErrorCode::InvalidInput, [&] { HarmonicSurface surface(coefficients); });
  };
  expect_refused({});
  expect_refused({1.0, 2.0, 3.0});
  expect_refused({std::numeric_limits<double>::infinity()});
  EXPECT_EQ(HarmonicSurface({1.0, 0.0, 0.0, 0.0}).degree(), 1);
}

TEST(HarmonicSurface, GradientEnergyFromCoefficients) {
  // Integral of |grad r|^2 = sum l (l + 1) a_lm^2 (Green), exact under the quadrature.
  const std::vector<double> a = grain_coefficients(14, 8);
  double expected = 0.0;
  for (int l = 0; l <= 14; ++l) {
    for (int m = -l; m <= l; ++m) expected += l * (l + 1.0) * std::pow(a[harmonic_index(l, m)], 2);
  }
  const SurfaceIntegrals integrals = integrate(HarmonicSurface(a), 45, Execution(1));
  EXPECT_NEAR(integrals.gradient_square, expected, 1e-12 * expected);
}

TEST(HarmonicSurface, JetsAgreeWithRadii) {
  const HarmonicSurface surface(grain_coefficients(10, 4));
  const std::vector<Vector3> u = random_directions(100, test::announced(12));
  const std::vector<double> radii = surface.radii(u, Execution(2));
  const std::vector<RadialJet> jets = surface.jets(u, Derivatives::Second, Execution(2));
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(radii[i], jets[i].radius);
}

}  // namespace
}  // namespace wscvt
