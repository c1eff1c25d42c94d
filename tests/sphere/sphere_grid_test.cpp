// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/sphere_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_transform.h"
#include "wscvt/surface/spherical_harmonics.h"

namespace wscvt {
namespace {

const double pi = std::acos(-1.0);

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

/// Two channels: all harmonics of one degree with unequal factors, and a linear function.
void two_fields(int degree, const Vector3* directions, std::size_t count, double* values) {
  std::vector<double> coefficients(harmonic_count(degree), 0.0);
  for (int m = -degree; m <= degree; ++m) {
    coefficients[harmonic_index(degree, m)] = 1.0 / (1.0 + std::abs(m - 2));
  }
  std::vector<double> first(count);
  HarmonicSeries(coefficients).sum(directions, count, first.data());
  for (std::size_t i = 0; i < count; ++i) {
    values[2 * i] = first[i];
    values[2 * i + 1] = directions[i].x() + 2.0 * directions[i].z();
  }
}

TEST(SphereGrid, InterpolatesWithinItsErrorBoundAlsoAcrossThePoles) {
  const std::vector<Vector3> u = directions_with_poles();
  const int degree = 6;
  std::vector<double> expected(2 * u.size());
  two_fields(degree, u.data(), u.size(), expected.data());
  double size = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) size = std::max(size, std::abs(expected[2 * i]));
  for (const auto& [stencil, constant] : {std::pair(4, 0.024), std::pair(6, 0.005)}) {
    for (const int rows : {48, 96}) {
      SCOPED_TRACE(testing::Message() << stencil << ' ' << rows);
      const SphereGrid grid(
          rows, 2, stencil,
          [&](const Vector3* directions, std::size_t count, double* values) {
            two_fields(degree, directions, count, values);
          },
          Execution(2));
      std::vector<double> values(2 * u.size());
      grid.interpolate(u.data(), u.size(), values.data());
      // The bound of the header in both angles; the sampled maximum may miss the true one by a
      // half.
      const double bound = 3.0 * constant * std::pow(degree * pi / rows, stencil) * size;
      double largest = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(values[i], expected[i], bound) << i;
        if (i % 2 == 0) largest = std::max(largest, std::abs(values[i] - expected[i]));
      }
      EXPECT_GT(largest, 0.02 * bound);
    }
  }
}

TEST(SphereGrid, ReturnsNodeValuesAtNodes) {
  const int rows = 16;
  std::vector<double> values;
  values.reserve(2 * rows * rows);
  for (int i = 0; i < 2 * rows * rows; ++i) values.push_back(std::sin(0.7 * i));
  for (const int stencil : {4, 6}) {
    const SphereGrid grid(rows, 1, stencil, values);
    EXPECT_EQ(grid.values(), values);
    const std::vector<Vector3> u = grid.directions();
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
    SphereGrid(rows, 1, stencil, field).interpolate(u.data(), u.size(), interpolated.data());
    const std::vector<double> shared = SphereGrid::spread(
                                           rows, 1, stencil, u,
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

TEST(SphereGrid, SpreadHasTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<Vector3> u = random_directions(200000, test::announced(3));
  const auto spread = [&](int threads) {
    return SphereGrid::spread(
               20, 2, 4, u,
               [&](std::size_t begin, std::size_t end, double* values) {
                 for (std::size_t i = begin; i < end; ++i) {
                   values[2 * (i - begin)] = u[i].x();
                   values[2 * (i - begin) + 1] = 1.0;
                 }
               },
               Execution(threads))
        .values();
  };
  const std::vector<double> one = spread(1);
  EXPECT_EQ(one, spread(2));
  EXPECT_EQ(one, spread(3));
  double sum = 0.0;
  for (std::size_t i = 1; i < one.size(); i += 2) sum += one[i];
  EXPECT_NEAR(sum, 200000.0, 1e-6);
}

TEST(SphereGrid, ValueDoesNotDependOnTheOtherDirections) {
  const SphereGrid grid(
      24, 2, 6,
      [](const Vector3* directions, std::size_t count, double* values) {
        two_fields(3, directions, count, values);
      },
      Execution(1));
  const std::vector<Vector3> u = random_directions(70, test::announced(2));
  std::vector<double> together(140);
  grid.interpolate(u.data(), u.size(), together.data());
  for (std::size_t i = 0; i < u.size(); ++i) {
    double alone[2] = {};
    grid.interpolate(&u[i], 1, alone);
    EXPECT_EQ(alone[0], together[2 * i]);
    EXPECT_EQ(alone[1], together[2 * i + 1]);
  }
}

TEST(SphereGrid, RefusesBadParameters) {
  EXPECT_THROW(SphereGrid(7, 1, 4), Error);
  EXPECT_THROW(SphereGrid(8, 0, 4), Error);
  EXPECT_THROW(SphereGrid(8, 1, 5), Error);
  EXPECT_THROW(SphereGrid(8, 1, 4, std::vector<double>(3)), Error);
}

}  // namespace
}  // namespace wscvt
