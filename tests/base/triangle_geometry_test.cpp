// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/triangle_geometry.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(TriangleGeometry, OfARightTriangle) {
  const Vector3 a(2, 0, 0);
  const Vector3 b(0, 3, 0);
  const Vector3 c(0, 0, 4);
  EXPECT_EQ(six_volumes(a, b, c), 24.0);
  EXPECT_EQ(six_volumes(a, c, b), -24.0);
  EXPECT_EQ(doubled_area_normal(a, b, c), Vector3(12, 8, 6));
  EXPECT_EQ(triangle_area({5, 5, 5}, {8, 5, 5}, {5, 9, 5}), 6.0);
}

TEST(TriangleGeometry, SumsOfABoxAreItsVolumeAreaAndMiddleAboutAnyOrigin) {
  IndexedMesh box = test::subdivided(test::box(1, 2, 3), 3);
  Vector3 middle = Vector3::Zero();  // of a body that is symmetric about it
  for (const Vector3& p : test::box(1, 2, 3).points) middle += p / 8.0;
  for (const Vector3& origin : {Vector3(0, 0, 0), Vector3(0.3, -0.2, 5), Vector3(-40, 30, 7)}) {
    const MeshSums sums = mesh_sums(box.points, box.triangles, origin, Execution(2));
    // Terms are up to 3 x 40^2, of which 1e-16 is lost in each of 768.
    EXPECT_NEAR(sums.volume(), 6.0, 1e-10);
    EXPECT_NEAR(sums.area(), 22.0, 1e-12);
    EXPECT_LT((origin + sums.centroid() - middle).norm(), 1e-9);
    EXPECT_EQ(sums.flat_triangles, 0U);
  }
}

TEST(TriangleGeometry, SumsCountTrianglesWithoutArea) {
  IndexedMesh box = test::box(1, 1, 1);
  box.triangles.push_back({0, 1, 1});
  EXPECT_EQ(mesh_sums(box.points, box.triangles, Vector3::Zero(), Execution(1)).flat_triangles, 1U);
}

TEST(TriangleGeometry, SumsAreTheSameBytesOnAnyNumberOfThreads) {
  const IndexedMesh sphere = test::sphere(6);
  ASSERT_GT(sphere.triangles.size(), 65536U);  // several blocks
  const MeshSums one = mesh_sums(sphere.points, sphere.triangles, {0.1, 0.2, 0.3}, Execution(1));
  const MeshSums four = mesh_sums(sphere.points, sphere.triangles, {0.1, 0.2, 0.3}, Execution(4));
  EXPECT_EQ(one.six_volumes, four.six_volumes);
  EXPECT_EQ(one.doubled_area, four.doubled_area);
  EXPECT_EQ(one.moment, four.moment);
}

TEST(TriangleGeometry, VertexAreasShareOutTheArea) {
  const IndexedMesh box = test::box(1, 2, 3);
  const std::vector<double> areas = vertex_areas(box);
  ASSERT_EQ(areas.size(), box.points.size());
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 22.0, 1e-12);
  const IndexedMesh one{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {9, 9, 9}}, {{0, 1, 2}}};
  EXPECT_EQ(vertex_areas(one), (std::vector<double>{2, 2, 2, 0}));
}

}  // namespace
}  // namespace wscvt
