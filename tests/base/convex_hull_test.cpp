// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {
namespace {

double volume(const IndexedMesh& mesh) { return describe_shape(mesh, Execution(1)).volume; }

TEST(ConvexHull, OfABoxWithPointsInsideIsTheBox) {
  IndexedMesh mesh = test::subdivided(test::box(1, 2, 3), 2);
  for (int i = 0; i < 100; ++i) mesh.points.push_back(0.004 * i * Vector3(1, -1, 1));
  EXPECT_NEAR(volume(convex_hull(mesh.points)), 6.0, 1e-12);
}

TEST(ConvexHull, OfAConvexBodyIsItself) {
  const IndexedMesh mesh = test::scaled(test::sphere(4), {1, 2, 3});
  const IndexedMesh hull = convex_hull(mesh.points);
  EXPECT_EQ(hull.points.size(), mesh.points.size());
  EXPECT_EQ(hull.triangles.size(), mesh.triangles.size());
  EXPECT_NEAR(volume(hull) / volume(mesh), 1.0, 1e-12);
}

TEST(ConvexHull, OfTwoCubesIsThePrismOverThem) {
  // Unit cubes at x = 0 and x = 3: a prism of 4 x 1 x 1.
  std::vector<Vector3> points = test::box(1, 1, 1).points;
  for (const Vector3& p : test::box(1, 1, 1).points) points.push_back(p + Vector3(3, 0, 0));
  EXPECT_NEAR(volume(convex_hull(points)), 4.0, 1e-14);
}

TEST(ConvexHull, NamesPointsOfTheInputInTheirOrder) {
  const std::vector<Vector3> points = {{0.2, 0.2, 0.2}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Triangle& t : convex_hull_triangles(points)) {
    for (const std::int32_t v : t) EXPECT_NE(v, 0);  // inside
  }
  EXPECT_EQ(convex_hull_triangles(points).size(), 4U);
  EXPECT_EQ(convex_hull(points).points, (std::vector<Vector3>(points.begin() + 1, points.end())));
}

TEST(ConvexHull, TrianglesComeInAnOrderOfTheirOwn) {
  // CGAL's differs from one run of a program to the next.
  const std::vector<Triangle> triangles = convex_hull_triangles(test::lumpy(4).points);
  EXPECT_TRUE(std::is_sorted(triangles.begin(), triangles.end()));
  for (const Triangle& t : triangles) EXPECT_EQ(t[0], *std::min_element(t.begin(), t.end()));
}

TEST(ConvexHull, PlaneFacesAreCutAlikeWhateverTheAddresses) {
  // A lattice's hull has faces of four corners and more, which CGAL cuts one way or the other.
  std::vector<Vector3> points;
  for (int x = -6; x <= 6; ++x) {
    for (int y = -6; y <= 6; ++y) {
      for (int z = -6; z <= 6; ++z) {
        if (x * x + y * y + z * z <= 40) points.emplace_back(x, y, z);
      }
    }
  }
  const std::vector<Triangle> once = convex_hull_triangles(points);
  std::vector<std::vector<char>> in_the_way;
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(convex_hull_triangles(points), once);
    in_the_way.emplace_back(static_cast<std::size_t>(1000 + 977 * k));
  }
  // About its first corner each: no edge within a plane lies farther from it than that corner.
  const std::vector<std::int32_t> opposite = link_half_edges(once, points.size()).opposite;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(opposite.size()); ++h) {
    const std::int32_t c = origin_of(once, previous_half_edge(h));
    const std::int32_t d = origin_of(once, previous_half_edge(opposite[h]));
    const Vector3& a = points[origin_of(once, h)];
    const Vector3 normal = (points[target_of(once, h)] - a).cross(points[c] - a);
    if (normal.dot(points[d] - a) != 0.0) continue;  // whole numbers: exact
    EXPECT_LT(std::min(origin_of(once, h), target_of(once, h)), std::min(c, d));
  }
}

TEST(ConvexHull, StopsWhenAskedTo) {
  // 40,962 points, each of which is asked several times on which side it lies.
  const std::vector<Vector3> points = test::sphere(6).points;
  test::expect_to_be_stopped([&](const Execution& execution) { convex_hull(points, execution); },
                             "Measuring the convex hull", 3);
}

TEST(ConvexHull, HasNoTrianglesInAPlane) {
  EXPECT_TRUE(convex_hull_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).empty());
  EXPECT_TRUE(convex_hull_triangles({}).empty());
  // A polygon of more triangles than a tetrahedron: its border has no other side.
  std::vector<Vector3> circle;
  for (int k = 0; k < 50; ++k) circle.emplace_back(std::cos(k), std::sin(k), 0.0);
  EXPECT_TRUE(convex_hull_triangles(circle).empty());
}

TEST(ConvexHull, RefusesAPlane) {
  EXPECT_ERROR(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), InvalidInput);
  EXPECT_ERROR(convex_hull({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), InvalidInput);
  EXPECT_ERROR(convex_hull({{0, 0, 0}}), InvalidInput);
  EXPECT_ERROR(convex_hull({}), InvalidInput);
}

}  // namespace

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
