// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/planar_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/seeds.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

std::vector<Vector2> cloud(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 engine(test::announced(seed));
  std::normal_distribution<double> normal;
  std::vector<Vector2> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(3.0 * normal(engine), normal(engine));
  return points;
}

double extent(const std::vector<Vector2>& points, const Vector2& along) {
  double low = along.dot(points[0]);
  double high = low;
  for (const Vector2& p : points) {
    low = std::min(low, along.dot(p));
    high = std::max(high, along.dot(p));
  }
  return high - low;
}

TEST(PlanarHull, HoldsEveryPointAndTurnsLeft) {
  std::vector<Vector2> points = cloud(1, 200);
  const std::vector<Vector2> all = points;
  const std::vector<Vector2> hull = planar_hull(points);
  ASSERT_GE(hull.size(), 3U);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2 edge = hull[(i + 1) % hull.size()] - hull[i];
    for (const Vector2& p : all) {
      const Vector2 d = p - hull[i];
      EXPECT_GE(edge.x() * d.y() - edge.y() * d.x(), -1e-12);
    }
  }
}

TEST(PlanarHull, LeavesOutWhatLiesOnItsSides) {
  std::vector<Vector2> points;
  for (int i = 0; i <= 4; ++i) {
    for (int k = 0; k <= 2; ++k) points.emplace_back(i, k);
  }
  EXPECT_EQ(planar_hull(points).size(), 4U);
  std::vector<Vector2> line = {{0, 0}, {1, 1}, {2, 2}};
  EXPECT_EQ(planar_hull(line).size(), 2U);
  std::vector<Vector2> one = {{3, 4}};
  EXPECT_EQ(planar_hull(one).size(), 1U);
  std::vector<Vector2> none;
  EXPECT_TRUE(planar_hull(none).empty());
}

TEST(SmallestRectangle, IsNoLargerThanAnyOtherAndHoldsAll) {
  for (const std::uint64_t seed : {2, 3, 4}) {
    std::vector<Vector2> points = cloud(seed, 40);
    const std::vector<Vector2> all = points;
    const Rectangle r = smallest_rectangle(planar_hull(points));
    EXPECT_NEAR(r.length, extent(all, r.side), 1e-12);
    EXPECT_NEAR(r.width, extent(all, {-r.side.y(), r.side.x()}), 1e-12);
    for (int k = 0; k < 720; ++k) {
      const double angle = test::pi * k / 720.0;
      const Vector2 side(std::cos(angle), std::sin(angle));
      EXPECT_LE(r.area(), extent(all, side) * extent(all, {-side.y(), side.x()}) + 1e-12);
    }
  }
}

TEST(SmallestRectangle, OfATurnedOneIsItself) {
  const Vector2 side(std::cos(0.3), std::sin(0.3));
  const Vector2 up(-side.y(), side.x());
  std::vector<Vector2> points = {
      {5, 5}, Vector2(5, 5) + 4 * side, Vector2(5, 5) + 4 * side + up, Vector2(5, 5) + up};
  const Rectangle r = smallest_rectangle(planar_hull(points));
  EXPECT_NEAR(r.area(), 4.0, 1e-12);
  EXPECT_NEAR(std::max(r.length, r.width), 4.0, 1e-12);
}

TEST(FarthestPair, IsThatOfAllPoints) {
  std::vector<Vector2> points = cloud(5, 100);
  double largest = 0.0;
  for (const Vector2& a : points) {
    for (const Vector2& b : points) largest = std::max(largest, (a - b).norm());
  }
  const FarthestPair pair = farthest_pair(planar_hull(points));
  EXPECT_DOUBLE_EQ(pair.distance, largest);
  EXPECT_DOUBLE_EQ((pair.to - pair.from).norm(), largest);
}

}  // namespace
}  // namespace wscvt
