// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/triangle_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

TEST(TrianglePlace, IsTheNearestPointAndSaysWhereItLies) {
  constexpr int seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  int regions[7] = {};
  for (int i = 0; i < 2000; ++i) {
    const Vector3 a = point();
    const Vector3 b = point();
    const Vector3 c = point();
    const Vector3 p = 2.0 * point();
    const TrianglePlace place = MeasuredTriangle(a, b, c).nearest(p);
    const Vector3 other = nearest_weights(a, b, c, p);
    // Both round some sixteen digits of lengths near one, divided by areas down to a thousandth.
    EXPECT_LT((place.weights - other).norm(), 1e-9);
    EXPECT_NEAR(place.squared_distance, (place.point(a, b, c) - p).squaredNorm(), 1e-9);
    ++regions[place.region];
    if (place.region == 0) {
      EXPECT_GT(place.weights.minCoeff(), 0.0);
    } else if (place.region <= 3) {
      EXPECT_EQ(place.weights[place.region - 1], 0.0);
    } else {
      EXPECT_EQ(place.weights[place.region - 4], 1.0);
    }
  }
  for (const int count : regions) EXPECT_GT(count, 50);
}

TEST(TrianglePlace, AWalkEndsAtTheNearestTriangleOfABall) {
  const IndexedMesh ball = test::sphere(3);
  const EditMesh mesh(ball.points, ball.triangles, Execution(1));
  std::int32_t t = 0;
  for (std::size_t v = 0; v < ball.points.size(); v += 7) {
    const Vector3 p = 1.1 * (ball.points[v] + Vector3(0.01, 0.02, -0.03));
    double nearest = 1e300;
    for (std::size_t u = 0; u < mesh.triangles.size(); ++u) {
      nearest = std::min(nearest, nearest_in_triangle(p, mesh, u).squared_distance);
    }
    EXPECT_NEAR(walk_to_nearest(p, mesh, t).squared_distance, nearest, 1e-14);
    EXPECT_NEAR(nearest_in_triangle(p, mesh, t).squared_distance, nearest, 1e-14);
  }
}

TEST(TrianglePlace, AWalkNeverChangesTheSheetOfAPlate) {
  const IndexedMesh plate = test::subdivided(test::box(4.0, 4.0, 0.02), 4);
  const EditMesh mesh(plate.points, plate.triangles, Execution(1));
  // From the middle of the top, a point just below the bottom: its nearest point is on the bottom.
  std::int32_t t = -1;
  for (std::size_t u = 0; u < mesh.triangles.size() && t < 0; ++u) {
    const auto& [a, b, c] = mesh.triangles[u];
    const Vector3 middle = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0;
    if (middle.z() > 0.009 && std::abs(middle.x()) < 0.3 && std::abs(middle.y()) < 0.3) {
      t = static_cast<std::int32_t>(u);
    }
  }
  ASSERT_GE(t, 0);
  const TrianglePlace place = walk_to_nearest(Vector3(0.4, 0.3, -0.011), mesh, t);
  EXPECT_NEAR(place.squared_distance, 0.021 * 0.021, 1e-12);
}

}  // namespace
}  // namespace wscvt
