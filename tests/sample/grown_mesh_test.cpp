// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/grown_mesh.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/random_sample.h"
#include "toolbox/sample/sample_grain.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/mesh_quality.h"

namespace wscvt {
namespace {

TEST(GrownMeshes, HaveExactlyTheNodesAndTheVolume) {
  const SampleGrids grids(8);
  const GrownMeshes meshes(213, Execution(1));
  for (const SampleGrain& grain : test::random_sample(4, grids, 21)) {
    const IndexedMesh mesh = meshes.mesh(grain.radial, 1.7);
    EXPECT_EQ(mesh.points.size(), 213U);
    EXPECT_EQ(mesh.triangles.size(), 2U * 213U - 4U);
    EXPECT_EQ(test::bad_edges(mesh), 0U);
    EXPECT_NEAR(describe_shape(mesh, Execution(1)).volume, 4.0 * pi / 3.0 * 1.7 * 1.7 * 1.7, 1e-9);
    const HarmonicSurface surface(grain.radial);
    const double scale = mesh.points[0].norm() / surface.radius(mesh.points[0].normalized());
    for (const Vector3& point : mesh.points) {
      EXPECT_NEAR(point.norm(), scale * surface.radius(point.normalized()), 1e-9);
    }
  }
  EXPECT_ERROR(GrownMeshes(3, Execution(1)), InvalidInput);
}

// The lattice's own triangles on an ellipsoid 3 : 1 : 1 have angles down to 13 degrees.
TEST(GrownMeshes, HaveNoThinTrianglesOnLongGrains) {
  std::vector<double> radial(harmonic_count(4), 0.0);
  radial[0] = std::sqrt(4.0 * pi);
  radial[harmonic_index(2, 2)] = 0.9;
  radial[harmonic_index(2, 0)] = -0.5;
  const IndexedMesh mesh = GrownMeshes(300, Execution(1)).mesh(radial, 1.0);
  EXPECT_GT(measure_quality(mesh, Execution(1)).smallest_angle, 20.0);
}

TEST(GrownMeshes, AreMeasured) {
  std::vector<double> radial(harmonic_count(4), 0.0);
  radial[0] = std::sqrt(4.0 * pi);
  const QuickShape ball =
      quick_shape(GrownMeshes(2000, Execution(1)).mesh(radial, 3.0), Execution(1));
  EXPECT_NEAR(ball.shape.sphericity, 1.0, 0.01);
  EXPECT_NEAR(ball.form.zingg_elongation, 1.0, 0.01);
  EXPECT_NEAR(ball.form.zingg_flatness, 1.0, 0.01);
  EXPECT_NEAR(ball.convexity, 1.0, 1e-9);
  const QuickShape box = quick_shape(test::box(6.0, 3.0, 2.0), Execution(1));
  EXPECT_NEAR(box.form.zingg_elongation, 0.5, 1e-9);
  EXPECT_NEAR(box.form.zingg_flatness, 2.0 / 3.0, 1e-9);
}

}  // namespace
}  // namespace wscvt
