// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/expect_error.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {
namespace {

std::vector<double> wave(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(std::sin(1.7 * static_cast<double>(i)));
  return values;
}

HarmonicTransform equal_angle_transform(int degree, int rows) {
  return {degree, SphereGrid::row_cosines(rows), SphereGrid::row_sines(rows), 2 * rows,
          Execution(1)};
}

TEST(HarmonicTransform, SynthesisIsTheSeriesAtTheNodes) {
  for (const int degree : {0, 1, 9}) {
    const int rows = 12;
    const std::vector<double> a = wave(harmonic_count(degree));
    const std::vector<double> values =
        equal_angle_transform(degree, rows).synthesize(a, Execution(2));
    const std::vector<Vector3> u = SphereGrid::directions(rows);
    std::vector<double> expected(u.size());
    HarmonicSeries(a).sum(u.data(), u.size(), expected.data());
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-12);
  }
}

TEST(HarmonicTransform, AnalysisIsTheTransposeOfSynthesis) {
  const int degree = 7;
  const HarmonicTransform transform = equal_angle_transform(degree, 40);
  const std::vector<double> a = wave(harmonic_count(degree));
  const std::vector<double> v = wave(transform.rows() * transform.azimuths());
  const std::vector<double> synthesized = transform.synthesize(a, Execution(1));
  const std::vector<double> analyzed = transform.analyze(v, Execution(1));
  double on_grid = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) on_grid += v[i] * synthesized[i];
  double on_coefficients = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) on_coefficients += a[k] * analyzed[k];
  EXPECT_NEAR(on_grid, on_coefficients, 1e-11);
}

TEST(HarmonicTransform, QuadratureOfASynthesisGivesTheCoefficientsBack) {
  const int degree = 60;
  const GaussLegendre nodes = gauss_legendre(degree + 1);
  std::vector<double> sines;
  for (const double z : nodes.nodes) sines.push_back(std::sqrt((1.0 - z) * (1.0 + z)));
  const int azimuths = 2 * degree + 1;
  const HarmonicTransform transform(degree, nodes.nodes, sines, azimuths, Execution(1));
  const std::vector<double> a = wave(harmonic_count(degree));
  std::vector<double> values = transform.synthesize(a, Execution(1));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] *= nodes.weights[i / transform.azimuths()] * 2.0 * pi / azimuths;
  }
  const std::vector<double> back = transform.analyze(values, Execution(1));
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(back[k], a[k], 1e-12);
}

// Eigen's product of matrices adds in an order that its blocks decide, and in fused steps on Arm.
TEST(HarmonicTransform, AddsOneTermAfterTheOther) {
  const int degree = 12;
  const int rows = 35;
  const HarmonicTransform transform = equal_angle_transform(degree, rows);
  const std::vector<double> coefficients = wave(harmonic_count(degree));
  const std::vector<double> values = transform.synthesize(coefficients, Execution(2));
  const std::vector<double> cosines = SphereGrid::row_cosines(rows);
  const std::vector<double> sines = SphereGrid::row_sines(rows);
  const std::vector<Eigen::Vector2d> circle = azimuth_circle(2 * rows);
  std::vector<double> expected(values.size(), 0.0);
  std::vector<double> legendre(cosines.size() * (degree + 1));
  for (int m = 0; m <= degree; ++m) {
    associated_legendre(degree, m, cosines.data(), sines.data(), cosines.size(), legendre.data());
    for (std::size_t place = 0; place < values.size(); ++place) {
      const std::size_t row = place / circle.size();
      Eigen::Vector2d sums = Eigen::Vector2d::Zero();
      for (int l = m; l <= degree; ++l) {
        const double along = legendre[static_cast<std::size_t>(l - m) * cosines.size() + row];
        sums.x() += coefficients[harmonic_index(l, m)] * along;
        if (m > 0) sums.y() += coefficients[harmonic_index(l, -m)] * along;
      }
      const Eigen::Vector2d& turn = circle[place * static_cast<std::size_t>(m) % circle.size()];
      expected[place] += sums.x() * turn.x();
      if (m > 0) expected[place] += sums.y() * turn.y();
    }
  }
  EXPECT_EQ(values, expected);
}

TEST(HarmonicTransform, SameBitsOnAnyNumberOfThreads) {
  const HarmonicTransform transform = equal_angle_transform(20, 100);
  const std::vector<double> a = wave(harmonic_count(20));
  const std::vector<double> values = transform.synthesize(a, Execution(1));
  EXPECT_EQ(values, transform.synthesize(a, Execution(3)));
  EXPECT_EQ(transform.analyze(values, Execution(1)), transform.analyze(values, Execution(3)));
}

TEST(HarmonicTransform, RefusesBadInput) {
  const Execution execution(1);
  EXPECT_ERROR(HarmonicTransform(-1, {0.0}, {1.0}, 4, execution), InvalidInput);
  EXPECT_ERROR(HarmonicTransform(2, {0.0}, {1.0, 1.0}, 4, execution), InvalidInput);
  EXPECT_ERROR(HarmonicTransform(2, {0.0}, {1.0}, 0, execution), InvalidInput);
  const HarmonicTransform transform(2, {0.0}, {1.0}, 4, execution);
  EXPECT_ERROR(transform.synthesize({1.0}, execution), InvalidInput);
  EXPECT_ERROR(transform.analyze({1.0}, execution), InvalidInput);
}

}  // namespace
}  // namespace wscvt
