// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/voxel_steps.h"

#include <gtest/gtest.h>

#include "support/test_shapes.h"
#include "support/voxel_body.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt {
namespace {

TEST(VoxelSteps, AreFoundWhateverTheSizeOfAVoxelAndItsPlace) {
  const IndexedMesh body = test::voxel_ellipsoid({7.3, 5.1, 4.2}, {8.1, 7.7, 8.4}, 17);
  EXPECT_TRUE(has_voxel_steps(body));
  IndexedMesh mesh = body;
  for (Vector3& p : mesh.points) {
    const Vector3 placed = p.cwiseProduct(Vector3(0.0123, 0.0123, 0.031)) + Vector3(10, -31, 4);
    p = placed.cast<float>().cast<double>();  // as STL keeps it
  }
  EXPECT_TRUE(has_voxel_steps(mesh));
  EXPECT_TRUE(check_mesh(mesh, {}, Execution(1)).report.has_voxel_steps);
  // The smallest of them.
  EXPECT_TRUE(has_voxel_steps(test::voxel_ellipsoid({3.0, 3.0, 3.0}, {4.5, 4.5, 4.5}, 9)));
}

TEST(VoxelSteps, AreNotFoundWhereOneFaceIsSlantedNorInPartsWithFewPlanes) {
  IndexedMesh mesh = test::voxel_ellipsoid({7.3, 5.1, 4.2}, {8.1, 7.7, 8.4}, 17);
  mesh.points.back().y() += 0.01;
  EXPECT_FALSE(has_voxel_steps(mesh));
  EXPECT_FALSE(has_voxel_steps(test::lumpy(3)));
  EXPECT_FALSE(has_voxel_steps(test::box(3, 2, 1)));
  // A box of many voxels, and a stair, which is as thick everywhere.
  EXPECT_FALSE(has_voxel_steps(test::voxel_body(12, [](int, int, int) { return true; })));
  EXPECT_FALSE(has_voxel_steps(test::voxel_body(12, [](int x, int y, int) { return y <= x; })));
}

}  // namespace
}  // namespace wscvt
