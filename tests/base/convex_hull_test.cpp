// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/cancelled_runs.h"
#include "support/expect_error.h"
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
}  // namespace wscvt
