// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/seeds.h"
#include "support/test_shapes.h"
#include "toolbox/map/sphere_map.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {
namespace {

/// Whether all triangles of p with the ring are counter-clockwise.
bool is_within(const Vector3& p, const std::vector<Vector3>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!counter_clockwise(p, ring[i], ring[(i + 1) % ring.size()])) return false;
  }
  return true;
}

/// A ring that edges from its apex triangulate, its kernel an angle there: directions at growing
/// angles about the apex, at random distances from it.
struct Ring {
  std::vector<Vector3> directions;
  std::vector<double> distances;
  std::size_t apex = 0;

  Ring(std::mt19937_64& engine, double size, double whole_angle, double decades = 0.7) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Eigen::Matrix3d rotation = test::random_rotation(engine());
    const int count = 4 + static_cast<int>(engine() % 5);
    directions.push_back(rotation.col(2));
    for (int i = 0; i < count; ++i) {
      const double angle = whole_angle * (i + 0.5 * share(engine)) / count;
      const double reach = size * std::pow(10.0, -decades * share(engine));
      directions.push_back(
          rotation * Vector3(reach * std::cos(angle), reach * std::sin(angle), 1.0).normalized());
    }
    apex = engine() % directions.size();
    std::rotate(directions.rbegin(), directions.rbegin() + static_cast<std::ptrdiff_t>(apex),
                directions.rend());
    for (std::size_t i = 0; i < directions.size(); ++i) distances.push_back(0.1 + share(engine));
  }
};

/// Whether a place is the mean of the ring, weighted by inverse distance.
bool is_mean(const Vector3& place, const Ring& ring) {
  Vector3 mean = Vector3::Zero();
  double size = 0.0;
  for (std::size_t i = 0; i < ring.directions.size(); ++i) {
    mean += ring.directions[i] / ring.distances[i];
    size = std::max(size, (ring.directions[i] - ring.directions[ring.apex]).norm());
  }
  // A millionth of the mean distance is added to each, against division by 0.
  return (place - mean.normalized()).norm() < 1e-4 * size;
}

TEST(KernelInsertion, FindsAPlaceWhereverTheApexSeesTheRing) {
  std::mt19937_64 engine(test::announced(1));
  int elsewhere = 0;
  int plain = 0;
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE(round);
    const double size = std::pow(10.0, 0.3 - round % 10);
    const double angle = test::pi * (0.2 + 1.7 * (round % 7) / 6.0);
    const Ring ring(engine, size, angle);
    const auto place = insert_into_kernel(ring.directions, ring.distances, ring.apex);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->norm(), 1.0, 1e-15);
    EXPECT_TRUE(is_within(*place, ring.directions));
    (is_mean(*place, ring) ? plain : elsewhere) += 1;
  }
  EXPECT_GT(elsewhere, 500);
  EXPECT_GT(plain, 200);
}

TEST(KernelInsertion, FindsAPlaceInKernelsThatAreTiny) {
  // Neighbours ever nearer to the apex leave a kernel down to a millionth of a millionth wide.
  std::mt19937_64 engine(test::announced(2));
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE(round);
    const double angle = test::pi * (0.2 + 1.7 * (round % 7) / 6.0);
    const Ring ring(engine, 0.5, angle, 4.0 + round % 9);
    const auto place = insert_into_kernel(ring.directions, ring.distances, ring.apex);
    ASSERT_TRUE(place);
    EXPECT_TRUE(is_within(*place, ring.directions));
  }
}

TEST(KernelInsertion, TakesTheMeanByInverseDistanceWhereItIsInside) {
  // A square about the pole, whose corners are as far as told.
  std::vector<Vector3> ring = {{1, 0, 4}, {0, 1, 4}, {-1, 0, 4}, {0, -1, 4}};
  for (Vector3& p : ring) p.normalize();
  for (const double unit : {1e-6, 1.0, 1e6}) {
    for (std::size_t apex = 0; apex < 4; ++apex) {
      auto place = insert_into_kernel(ring, std::vector<double>(4, unit), apex);
      ASSERT_TRUE(place);
      EXPECT_LT((*place - Vector3::UnitZ()).norm(), 1e-12);
      place = insert_into_kernel(ring, {unit, 2 * unit, 4 * unit, 2 * unit}, apex);
      ASSERT_TRUE(place);
      const Vector3 mean = (4 * ring[0] + 2 * ring[1] + ring[2] + 2 * ring[3]).normalized();
      EXPECT_LT((*place - mean).norm(), 1e-5);
    }
  }
  // At no distance from one of them, or from all.
  EXPECT_TRUE(insert_into_kernel(ring, {0.0, 1.0, 1.0, 1.0}, 0));
  const auto even = insert_into_kernel(ring, {0.0, 0.0, 0.0, 0.0}, 0);
  ASSERT_TRUE(even);
  EXPECT_LT((*even - Vector3::UnitZ()).norm(), 1e-12);
}

TEST(KernelInsertion, TakesTheCentroidOfTheKernelElsewhere) {
  // Against points of a fine lattice in the plane that touches the sphere at the apex, in which the
  // kernel is a polygon: those that the whole ring is seen from.
  std::mt19937_64 engine(test::announced(3));
  int compared = 0;
  for (int round = 0; round < 60 && compared < 15; ++round) {
    SCOPED_TRACE(round);
    const double size = round % 2 == 0 ? 0.6 : 1e-3;
    const Ring ring(engine, size, 4.0);
    const auto place = insert_into_kernel(ring.directions, ring.distances, ring.apex);
    ASSERT_TRUE(place);
    if (is_mean(*place, ring)) continue;
    const Vector3& o = ring.directions[ring.apex];
    const Vector3 e1 = o.unitOrthogonal();
    const Vector3 e2 = o.cross(e1);
    constexpr int half = 100;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int count = 0;
    for (int i = -half; i <= half; ++i) {
      for (int j = -half; j <= half; ++j) {
        const Eigen::Vector2d x = size / half * Eigen::Vector2d(i + 0.5, j + 0.5);
        if (!is_within((o + x[0] * e1 + x[1] * e2).normalized(), ring.directions)) continue;
        sum += x;
        ++count;
      }
    }
    if (count < 300) continue;  // too few for a mean
    ++compared;
    const Vector3 expected = (o + sum[0] / count * e1 + sum[1] / count * e2).normalized();
    EXPECT_LT((*place - expected).norm(), 0.01 * size) << count;
  }
  EXPECT_GE(compared, 10);
}

}  // namespace
}  // namespace wscvt
