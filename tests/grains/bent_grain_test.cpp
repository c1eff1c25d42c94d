// SPDX-License-Identifier: GPL-3.0-or-later
#include "grains/bent_grain.h"

#include <gtest/gtest.h>

#include <map>

#include "support/test_shapes.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/overhangs.h"

namespace wscvt {
namespace {

TEST(BentGrains, AreClosedWithoutHandlesAndOfTheSizeAskedFor) {
  for (const test::BentGrain& grain : test::bent_grains()) {
    const IndexedMesh mesh = test::bent_grain_mesh(grain, 5000);
    EXPECT_NEAR(static_cast<double>(mesh.points.size()), 5000.0, 250.0) << grain.name;
    EXPECT_EQ(test::bad_edges(mesh), 0U) << grain.name;
    EXPECT_EQ(check_mesh(mesh, {}, Execution(1)).report.genus, 0) << grain.name;
    for (const Vector3& p : mesh.points) {
      // Roughness of rms 0.008, and the blur rounds the horns and rims.
      ASSERT_NEAR(grain.depth(p), 0.0, 0.08) << grain.name;
    }
  }
}

TEST(BentGrains, AreFarFromStarShaped) {
  // The flake and the rod are thin, not bent; of the others folds hide at least this share.
  const std::map<std::string, double> folds{{"crescent", 0.05}, {"bowl", 0.3},
                                            {"C-shape", 0.3},   {"hook", 0.3},
                                            {"mushroom", 0.01}, {"aggregate", 0.008}};
  for (const auto& [name, fold] : folds) {
    const CheckedMesh mesh =
        check_mesh(test::bent_grain_mesh(test::bent_grain(name), 5000), {}, Execution(1));
    EXPECT_GT(overhang_solid_angle(mesh.mesh, mesh.report.centroid, Execution(1)), fold) << name;
  }
}

}  // namespace
}  // namespace wscvt
