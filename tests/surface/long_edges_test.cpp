// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/long_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

TEST(LongEdges, AreHalvedUntilNoneIsLeftOnTheSameSurface) {
  const IndexedMesh ball = test::sphere(1);
  EditMesh mesh(ball.points, ball.triangles, Execution(1));
  const double before = mean_edge_length(mesh);
  const double most = 0.3 * before;
  const SplitScan split = split_long_edges(mesh, most, 100000, Execution(1));
  ASSERT_EQ(split.normals.size(), split.mesh.points.size());
  EXPECT_EQ(mesh.points.size(), split.mesh.points.size());
  for (const auto& [a, b, c] : split.mesh.triangles) {
    EXPECT_LE((split.mesh.points[a] - split.mesh.points[b]).norm(), most);
    EXPECT_LE((split.mesh.points[b] - split.mesh.points[c]).norm(), most);
    EXPECT_LE((split.mesh.points[c] - split.mesh.points[a]).norm(), most);
  }
  const MeshSums old_sums = mesh_sums(ball.points, ball.triangles, Vector3::Zero(), Execution(1));
  const MeshSums sums =
      mesh_sums(split.mesh.points, split.mesh.triangles, Vector3::Zero(), Execution(1));
  EXPECT_NEAR(sums.volume(), old_sums.volume(), 1e-12);
  EXPECT_NEAR(sums.area(), old_sums.area(), 1e-12);
  // Sorted with their vertices: on a ball about the origin, normals point where the vertices are.
  for (std::size_t v = 0; v < split.normals.size(); ++v) {
    EXPECT_NEAR(split.normals[v].norm(), 1.0, 1e-12);
    EXPECT_GT(split.normals[v].dot(split.mesh.points[v].normalized()), 0.99);
  }
}

TEST(LongEdges, AreRefusedIfTheyNeedTooManyVertices) {
  const IndexedMesh ball = test::sphere(1);
  EditMesh mesh(ball.points, ball.triangles, Execution(1));
  EXPECT_THROW(split_long_edges(mesh, 0.01, 10, Execution(1)), Error);
}

TEST(SpaceOrder, NumbersEveryPointOnceAndNearOnesTogether) {
  const IndexedMesh body = test::shuffled(test::scaled(test::sphere(4), Vector3(3.0, 1.0, 0.5)), 7);
  const std::vector<std::int32_t> order = space_order(body.points);
  std::vector<std::int32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> all(body.points.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
  const auto length = [&](const std::vector<std::int32_t>& numbers) {
    double sum = 0.0;
    for (std::size_t i = 1; i < numbers.size(); ++i) {
      sum += (body.points[numbers[i]] - body.points[numbers[i - 1]]).norm();
    }
    return sum / static_cast<double>(numbers.size());
  };
  // 2,562 points stand .06 apart; a curve that fills space jumps now and then.
  EXPECT_LT(length(order), 0.2);
  EXPECT_GT(length(all), 1.0);
  EXPECT_TRUE(space_order({}).empty());
  EXPECT_EQ(space_order({Vector3(1, 2, 3), Vector3(1, 2, 3)}), (std::vector<std::int32_t>{0, 1}));
}

TEST(SpaceOrder, LeavesTheMeshWhatItWas) {
  const IndexedMesh body = test::shuffled(test::lumpy(3), 5);
  IndexedMesh ordered = body;
  const std::vector<std::int32_t> order = order_in_space(ordered.points, ordered.triangles);
  ASSERT_EQ(order.size(), body.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(ordered.points[i], body.points[order[i]]);
  }
  std::vector<Triangle> named_as_before;
  for (const Triangle& t : ordered.triangles) {
    named_as_before.push_back({order[t[0]], order[t[1]], order[t[2]]});
  }
  std::vector<Triangle> before = body.triangles;
  std::sort(before.begin(), before.end());
  std::sort(named_as_before.begin(), named_as_before.end());
  EXPECT_EQ(named_as_before, before);
  EXPECT_TRUE(std::is_sorted(ordered.triangles.begin(), ordered.triangles.end(),
                             [](const Triangle& a, const Triangle& b) {
                               return std::min({a[0], a[1], a[2]}) < std::min({b[0], b[1], b[2]});
                             }));
}

}  // namespace

}  // namespace wscvt
