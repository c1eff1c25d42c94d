// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/triangle_hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "support/test_shapes.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

/// Two balls that overlap: many pairs that meet.
IndexedMesh two_balls() {
  return test::joined(test::sphere(2), test::moved(test::sphere(2), 0.9, Vector3(1.21, 0.13, 0.2)));
}

TEST(TriangleHash, FindsThePairsThatExactPredicatesFind) {
  const IndexedMesh balls = two_balls();
  const EditMesh mesh(balls.points, balls.triangles, Execution(1));
  const std::vector<TrianglePair> exact = self_intersections(balls);
  ASSERT_GT(exact.size(), 50u);
  for (const double cell : {0.05, 0.3, 3.0}) {
    SCOPED_TRACE(cell);
    TriangleHash hash;
    hash.build(mesh, cell);
    EXPECT_EQ(hash.pairs(mesh, Execution(2)), exact);
  }
}

TEST(TriangleHash, FindsPairsWithinTheFansOfVertices) {
  // Nodes shaken by their edges: fans fold over and wind twice.
  IndexedMesh shaken = test::sphere(2);
  constexpr int seed = 8;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.25, 0.25);
  for (Vector3& p : shaken.points) p += Vector3(uniform(random), uniform(random), uniform(random));
  const std::vector<TrianglePair> exact = self_intersections(shaken);
  const auto share_one = [&](const TrianglePair& pair) {
    int shared = 0;
    for (const std::int32_t v : shaken.triangles[pair.first]) {
      const Triangle& other = shaken.triangles[pair.second];
      shared += static_cast<int>(std::count(other.begin(), other.end(), v));
    }
    return shared == 1;
  };
  ASSERT_GT(std::count_if(exact.begin(), exact.end(), share_one), 20);
  const EditMesh mesh(shaken.points, shaken.triangles, Execution(1));
  TriangleHash hash;
  hash.build(mesh, 0.3);
  EXPECT_EQ(hash.pairs(mesh, Execution(1)), exact);
}

TEST(TriangleHash, AsksOfATriangleThatIsNotThereYet) {
  const IndexedMesh ball = test::sphere(2);
  EditMesh mesh(ball.points, ball.triangles, Execution(1));
  TriangleHash hash;
  hash.build(mesh, 0.3);
  const std::array<Vector3, 3> through = {Vector3(0.0, 0.0, 0.1), Vector3(0.1, 0.0, 2.0),
                                          Vector3(0.0, 0.1, 2.0)};
  EXPECT_TRUE(hash.meets(mesh, {-1, -1, -1}, through, {}));
  std::vector<std::int32_t> met;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (triangles_cross({-1, -1, -1}, through, mesh.triangles[t],
                        {mesh.points[a], mesh.points[b], mesh.points[c]})) {
      met.push_back(static_cast<std::int32_t>(t));
    }
  }
  ASSERT_FALSE(met.empty());
  EXPECT_FALSE(hash.meets(mesh, {-1, -1, -1}, through, met));
  const std::array<Vector3, 3> inside = {Vector3(0.0, 0.0, 0.1), Vector3(0.1, 0.0, 0.2),
                                         Vector3(0.0, 0.1, 0.2)};
  EXPECT_FALSE(hash.meets(mesh, {-1, -1, -1}, inside, {}));
  // Its own fan is no hindrance to a node that moves.
  const std::int32_t v = mesh.triangles[0][0];
  const auto& [a, b, c] = mesh.triangles[0];
  EXPECT_FALSE(
      hash.meets(mesh, {a, b, c}, {0.9 * mesh.points[a], mesh.points[b], mesh.points[c]}, {0}, v));
}

TEST(TriangleHash, KnowsATriangleThatWasMoved) {
  const IndexedMesh ball = test::sphere(2);
  EditMesh mesh(ball.points, ball.triangles, Execution(1));
  TriangleHash hash;
  hash.build(mesh, 0.1);
  const std::int32_t v = mesh.triangles[0][0];
  const std::array<Vector3, 3> far = {3.0 * mesh.points[v], 3.1 * mesh.points[v] + Vector3(0, 0, 1),
                                      3.1 * mesh.points[v] - Vector3(0.3, 0, 1)};
  EXPECT_FALSE(hash.meets(mesh, {-1, -1, -1}, far, {}));
  mesh.points[v] *= 4.0;
  mesh.around(v, [&](std::int32_t h) { hash.enter(mesh, static_cast<std::int32_t>(face_of(h))); });
  // A triangle across the spike.
  const Vector3 at = 0.6 * mesh.points[v];
  const Vector3 e1 = at.unitOrthogonal();
  const Vector3 e2 = at.normalized().cross(e1);
  EXPECT_TRUE(
      hash.meets(mesh, {-1, -1, -1}, {at + 2.0 * e1, at - e1 + 1.7 * e2, at - e1 - 1.7 * e2}, {}));
}

TEST(IntersectionMending, PartsAKnotAndLeavesTheRest) {
  const IndexedMesh ball = test::sphere(3);
  EditMesh mesh(ball.points, ball.triangles, Execution(1));
  EXPECT_EQ(part_triangles(mesh, Execution(1)).before, 0u);
  EXPECT_EQ(mesh.points, ball.points);
  constexpr std::int32_t v = 100;
  constexpr int seed = 3;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double edge = mean_edge_length(mesh);
  std::vector<std::int32_t> knot = {v};
  mesh.around(v, [&](std::int32_t h) { knot.push_back(mesh.target(h)); });
  for (const std::int32_t i : knot) {
    mesh.points[i] += edge * Vector3(uniform(random), uniform(random), uniform(random));
  }
  const std::size_t pairs = self_intersections({mesh.points, mesh.triangles}).size();
  ASSERT_GT(pairs, 0u);
  const PartingReport report = part_triangles(mesh, Execution(1));
  EXPECT_EQ(report.before, pairs);
  EXPECT_EQ(report.after, 0u);
  EXPECT_TRUE(self_intersections({mesh.points, mesh.triangles}).empty());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < ball.points.size(); ++i) {
    if (mesh.points[i] != ball.points[i]) ++moved;
  }
  EXPECT_LT(moved, 70u);  // of 642; three rings hold 37 nodes and the knot's more
}

}  // namespace
}  // namespace wscvt
