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
