// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/long_edges.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace wscvt
