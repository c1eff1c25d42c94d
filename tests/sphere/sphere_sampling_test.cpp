// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/sphere_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"

namespace wscvt {
namespace {

void expect_distinct_unit_vectors(const std::vector<Vector3>& points) {
  for (const Vector3& point : points) EXPECT_NEAR(point.norm(), 1.0, 1e-15 * 4);
  EXPECT_GT(test::smallest_distance(points), 0.0);
}

TEST(GaussLegendre, IntegratesPolynomialsUpToTheirDegreeExactly) {
  for (const int count : {1, 2, 3, 8, 61}) {
    const GaussLegendre rule = gauss_legendre(count);
    for (int degree = 0; degree < 2 * count; ++degree) {
      double sum = 0.0;
      for (int i = 0; i < count; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
      const double exact = degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0;
      EXPECT_NEAR(sum, exact, 1e-14) << count << " nodes, degree " << degree;
    }
  }
}

TEST(GaussLegendreSphere, IntegratesMonomialsExactly) {
  const SphereQuadrature quadrature = gauss_legendre_sphere(6);
  double one = 0.0;
  double z4 = 0.0;
  double x2y2z2 = 0.0;
  for (std::size_t i = 0; i < quadrature.weights.size(); ++i) {
    const Vector3& u = quadrature.directions[i];
    const double w = quadrature.weights[i];
    one += w;
    z4 += w * std::pow(u.z(), 4);
    x2y2z2 += w * std::pow(u.x() * u.y() * u.z(), 2);
  }
  EXPECT_NEAR(one, 4.0 * pi, 1e-13);
  EXPECT_NEAR(z4, 4.0 * pi / 5.0, 1e-13);
  EXPECT_NEAR(x2y2z2, 4.0 * pi / 105.0, 1e-13);
}

TEST(SphereSampling, LatticesHaveTheCountAskedForAndStandApart) {
  for (const int count : {1, 4, 5, 12, 500}) {
    const std::vector<Vector3> points = fibonacci_lattice(count);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
    expect_distinct_unit_vectors(points);
  }
  // The densest packing of N points has neighbours 3.81/sqrt(N) apart; a lattice fit to start from
  // keeps at least two fifths of that everywhere, poles included.
  EXPECT_GT(test::smallest_distance(fibonacci_lattice(1000)), 1.5 / std::sqrt(1000.0));
}

TEST(SphereSampling, RandomDirectionsRepeatWithTheSeedAndAreCentred) {
  const std::vector<Vector3> points = random_directions(20000, 7);
  EXPECT_EQ(points, random_directions(20000, 7));
  EXPECT_NE(points, random_directions(20000, 8));
  Vector3 mean = Vector3::Zero();
  for (const Vector3& point : points) mean += point / 20000.0;
  // Each component has variance 1/3, so the mean's deviation is 0.0041; five of them.
  EXPECT_LT(mean.norm(), 0.0205);
}

TEST(SphereSampling, ConstantDensityLeavesTheLatticeEven) {
  const auto constant = [](const std::vector<Vector3>& u) {
    return std::vector<double>(u.size(), 3.0);
  };
  const std::vector<Vector3> warped = warped_lattice(500, constant, 90);
  const std::vector<Vector3> plain = fibonacci_lattice(500);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR((warped[i] - plain[i]).norm(), 0.0, 1e-12);
  }
}

TEST(SphereSampling, WarpedLatticeFollowsTheDensity) {
  // Density 1 + 0.9 x: a cap's share is its integral. Checked over the two halves x > 0 and x < 0:
  // (2 pi + 0.9 pi) / 4 pi.
  const auto density = [](const std::vector<Vector3>& u) {
    std::vector<double> values;
    for (const Vector3& v : u) values.push_back(1.0 + 0.9 * v.x());
    return values;
  };
  const std::vector<Vector3> points = warped_lattice(4000, density, 120);
  const auto front =
      std::count_if(points.begin(), points.end(), [](const Vector3& v) { return v.x() > 0.0; });
  // The lattice puts whole points on either side of the boundary: half a ring of sqrt(pi N) points.
  EXPECT_NEAR(static_cast<double>(front) / 4000.0, 2.9 / 4.0, 0.5 * std::sqrt(pi / 4000.0));
}

TEST(SphereSampling, RefusesADensityThatIsNotPositive) {
  const auto density = [](const std::vector<Vector3>& u) {
    std::vector<double> values;
    for (const Vector3& v : u) values.push_back(v.z());
    return values;
  };
  EXPECT_ERROR(warped_lattice(100, density, 20), InvalidInput);
}

TEST(SphereSampling, SubdividedIcosahedronIsOneCutAtTheMiddlesOfItsEdges) {
  // Cut in a straight line and projected once, however often: four parts an edge.
  std::vector<Vector3> expected = test::subdivided(test::icosahedron(), 2).points;
  for (Vector3& p : expected) p.normalize();
  const std::vector<Vector3> points = subdivided_icosahedron(4);
  ASSERT_EQ(points.size(), expected.size());
  for (const Vector3& p : expected) {
    const auto there = std::count_if(points.begin(), points.end(),
                                     [&](const Vector3& q) { return (p - q).norm() < 1e-14; });
    EXPECT_EQ(there, 1) << p.transpose();
  }
}

TEST(SphereSampling, GridsHaveTheirCountsAndTheNearestIsNearest) {
  EXPECT_EQ(equal_angle_grid(3).size(), 26U);
  expect_distinct_unit_vectors(equal_angle_grid(7));
  for (const int frequency : {1, 2, 3, 7}) {
    const std::vector<Vector3> points = subdivided_icosahedron(frequency);
    EXPECT_EQ(points.size(), 10U * frequency * frequency + 2U);
    expect_distinct_unit_vectors(points);
  }
  EXPECT_EQ(nearest_subdivided_icosahedron(1000).size(), 1002U);
  EXPECT_EQ(nearest_subdivided_icosahedron(4).size(), 12U);
  EXPECT_EQ(nearest_equal_angle_grid(1000).size(), 1014U);  // 21 parallels give 926
}

}  // namespace
}  // namespace wscvt
