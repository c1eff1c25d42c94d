// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/sphere_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {
namespace {

std::vector<Vector3> directions_with_poles() {
  std::vector<Vector3> u = random_directions(2000, test::announced(7));
  for (const double sign : {1.0, -1.0}) {
    u.emplace_back(sign * Vector3::UnitZ());
    u.emplace_back(sign * Vector3::UnitX());
    u.emplace_back(sign * Vector3::UnitY());
    for (const double tilt : {1e-300, 1e-9, 1e-3, 0.05}) {
      u.emplace_back(Vector3(tilt, -tilt, sign).normalized());
      u.emplace_back(Vector3(1.0, sign * tilt, 0.0).normalized());
    }
  }
  // Just below a full turn.
  u.emplace_back(Vector3(1.0, -1e-17, 0.0));
  return u;
}

/// All harmonics of one degree with unequal factors.
std::vector<double> harmonics(int degree, const std::vector<Vector3>& directions) {
  std::vector<double> coefficients(harmonic_count(degree), 0.0);
  for (int m = -degree; m <= degree; ++m) {
    coefficients[harmonic_index(degree, m)] = 1.0 / (1.0 + std::abs(m - 2));
  }
  std::vector<double> values(directions.size());
  HarmonicSeries(coefficients).sum(directions.data(), directions.size(), values.data());
  return values;
}

/// A linear function.
std::vector<double> slope(const std::vector<Vector3>& directions) {
  std::vector<double> values;
  values.reserve(directions.size());
  for (const Vector3& u : directions) values.push_back(u.x() + 2.0 * u.z());
  return values;
}

TEST(SphereGrid, InterpolatesWithinItsErrorBoundAlsoAcrossThePoles) {
  const std::vector<Vector3> u = directions_with_poles();
  const int degree = 6;
  const std::vector<double> expected = harmonics(degree, u);
  const std::vector<double> expected_slope = slope(u);
  double size = 0.0;
  for (const double value : expected) size = std::max(size, std::abs(value));
  for (const auto& [stencil, constant] : {std::pair(4, 0.024), std::pair(6, 0.005)}) {
    for (const int rows : {48, 96}) {
      SCOPED_TRACE(testing::Message() << stencil << ' ' << rows);
      const std::vector<Vector3> nodes = SphereGrid::directions(rows);
      std::vector<double> values(u.size());
      SphereGrid(rows, stencil, harmonics(degree, nodes))
          .interpolate(u.data(), u.size(), values.data());
      // The bound of the header in both angles; the sampled maximum may miss the true one by a
      // half.
      const double bound = 3.0 * constant * std::pow(degree * pi / rows, stencil) * size;
      double largest = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(values[i], expected[i], bound) << i;
        largest = std::max(largest, std::abs(values[i] - expected[i]));
      }
      EXPECT_GT(largest, 0.02 * bound);
      SphereGrid(rows, stencil, slope(nodes)).interpolate(u.data(), u.size(), values.data());
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(values[i], expected_slope[i], bound) << i;
      }
    }
  }
}

TEST(SphereGrid, ReturnsNodeValuesAtNodes) {
  const int rows = 16;
  std::vector<double> values;
  values.reserve(2 * rows * rows);
  for (int i = 0; i < 2 * rows * rows; ++i) values.push_back(std::sin(0.7 * i));
  for (const int stencil : {4, 6}) {
    const SphereGrid grid(rows, stencil, values);
    EXPECT_EQ(grid.values(), values);
    const std::vector<Vector3> u = SphereGrid::directions(rows);
    ASSERT_EQ(u.size(), values.size());
    std::vector<double> found(u.size());
    grid.interpolate(u.data(), u.size(), found.data());
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(found[i], values[i], 1e-12);
  }
}

TEST(SphereGrid, SpreadIsTheTransposeOfInterpolation) {
  const int rows = 12;
  const std::vector<Vector3> u = directions_with_poles();
  std::vector<double> field;
  field.reserve(2 * rows * rows);
  for (int i = 0; i < 2 * rows * rows; ++i) field.push_back(std::cos(1.3 * i));
  std::vector<double> weights;
  weights.reserve(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    weights.push_back(std::sin(0.3 * static_cast<double>(i)));
  }
  for (const int stencil : {4, 6}) {
    std::vector<double> interpolated(u.size());
    SphereGrid(rows, stencil, field).interpolate(u.data(), u.size(), interpolated.data());
    const std::vector<double> shared = SphereGrid::spread(
                                           rows, stencil, u,
                                           [&](std::size_t begin, std::size_t end, double* values) {
                                             for (std::size_t i = begin; i < end; ++i)
                                               values[i - begin] = weights[i];
                                           },
                                           Execution(1))
                                           .values();
    double over_points = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) over_points += weights[i] * interpolated[i];
    double over_nodes = 0.0;
    for (std::size_t i = 0; i < field.size(); ++i) over_nodes += shared[i] * field[i];
    EXPECT_NEAR(over_points, over_nodes, 1e-11);
  }
}

TEST(SphereGrid, SpreadIsInterpolatedAsItsValuesAre) {
  const int rows = 12;
  const std::vector<Vector3> u = directions_with_poles();
  const SphereGrid shared = SphereGrid::spread(
      rows, 4, u,
      [&](std::size_t begin, std::size_t end, double* values) {
        for (std::size_t i = begin; i < end; ++i) values[i - begin] = 1.0 + u[i].y();
      },
      Execution(1));
  std::vector<double> found(u.size());
  shared.interpolate(u.data(), u.size(), found.data());
  std::vector<double> expected(u.size());
  SphereGrid(rows, 4, shared.values()).interpolate(u.data(), u.size(), expected.data());
  EXPECT_EQ(found, expected);
}

TEST(SphereGrid, SpreadHasTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<Vector3> u = random_directions(200000, test::announced(3));
  const auto spread = [&](int threads) {
    return SphereGrid::spread(
               20, 4, u,
               [&](std::size_t begin, std::size_t end, double* values) {
                 for (std::size_t i = begin; i < end; ++i) values[i - begin] = 1.0 + u[i].x();
               },
               Execution(threads))
        .values();
  };
  const std::vector<double> one = spread(1);
  EXPECT_EQ(one, spread(2));
  EXPECT_EQ(one, spread(3));
  double expected = 0.0;
  for (const Vector3& p : u) expected += 1.0 + p.x();
  EXPECT_NEAR(std::accumulate(one.begin(), one.end(), 0.0), expected, 1e-6);
}

TEST(SphereGrid, ValueDoesNotDependOnTheOtherDirections) {
  const SphereGrid grid(24, 6, harmonics(3, SphereGrid::directions(24)));
  const std::vector<Vector3> u = random_directions(70, test::announced(2));
  std::vector<double> together(u.size());
  grid.interpolate(u.data(), u.size(), together.data());
  for (std::size_t i = 0; i < u.size(); ++i) {
    double alone = 0.0;
    grid.interpolate(&u[i], 1, &alone);
    EXPECT_EQ(alone, together[i]);
  }
}

TEST(SphereGrid, RefusesBadParameters) {
  EXPECT_ERROR(SphereGrid(7, 4), InvalidInput);
  EXPECT_ERROR(SphereGrid(8, 5), InvalidInput);
  EXPECT_ERROR(SphereGrid(8, 4, std::vector<double>(3)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
