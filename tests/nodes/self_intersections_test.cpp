// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/self_intersections.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

TEST(SelfIntersections, ConvexBodiesHaveNone) {
  EXPECT_TRUE(self_intersections(test::sphere(3)).empty());
  EXPECT_TRUE(self_intersections(test::box(1.0, 2.0, 3.0)).empty());
}

TEST(SelfIntersections, AVertexPushedThroughTheOtherSideIsFound) {
  IndexedMesh mesh = test::sphere(2);
  const Vector3 apex = mesh.points[0];
  mesh.points[0] = -1.5 * apex;
  const auto pairs = self_intersections(mesh);
  ASSERT_FALSE(pairs.empty());
  for (const auto& [a, b] : pairs) {
    EXPECT_LT(a, b);
    const auto has_apex = [&](std::int32_t t) {
      const Triangle& corners = mesh.triangles[t];
      return corners[0] == 0 || corners[1] == 0 || corners[2] == 0;
    };
    EXPECT_TRUE(has_apex(a) || has_apex(b));
  }
  const auto vertices = vertices_of(pairs, mesh.triangles);
  EXPECT_EQ(vertices.front(), 0);
  EXPECT_LT(vertices.size(), mesh.points.size());
}

TEST(TrianglesMeet, ElsewhereThanInWhatTheyShare) {
  const std::vector<Vector3> points = {{0, 0, 0},   {2, 0, 0},   {0, 2, 0}, {0.5, 0.5, -1},
                                       {1, 0.5, 1}, {0.5, 1, 1}, {0, 0, 2}, {2, 2, 1}};
  const Triangle floor = {0, 1, 2};
  EXPECT_TRUE(triangles_meet(points, floor, {3, 4, 5})) << "through its middle";
  EXPECT_FALSE(triangles_meet(points, floor, {4, 5, 6})) << "above it";
  EXPECT_FALSE(triangles_meet(points, floor, {1, 2, 3})) << "on the other side of an edge";
  EXPECT_FALSE(triangles_meet(points, floor, {0, 6, 7})) << "from a corner upwards";
  EXPECT_TRUE(triangles_meet(points, floor, {0, 3, 7})) << "from a corner, and through it";
  EXPECT_FALSE(triangles_meet(points, floor, floor));
}

TEST(TrianglesMeet, AsAllPairsOfAMeshDo) {
  IndexedMesh mesh = test::sphere(2);
  mesh.points[0] *= -1.5;
  mesh.points[20] *= -0.9;
  std::vector<TrianglePair> pairs;
  for (std::size_t a = 0; a < mesh.triangles.size(); ++a) {
    for (std::size_t b = a + 1; b < mesh.triangles.size(); ++b) {
      if (!triangles_meet(mesh.points, mesh.triangles[a], mesh.triangles[b])) continue;
      pairs.emplace_back(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
    }
  }
  EXPECT_EQ(pairs, self_intersections(mesh));
}

TEST(SelfIntersections, RefusesWhatIsNoManifold) {
  IndexedMesh mesh = test::sphere(0);
  mesh.triangles.push_back(mesh.triangles.front());
  try {
    self_intersections(mesh);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_NE(std::string(error.what()).find("mend it first"), std::string::npos);
  }
}

}  // namespace
}  // namespace wscvt
