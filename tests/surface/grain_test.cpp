// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/grain.h"

#include <gtest/gtest.h>

#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

TEST(Grain, RaysOfAScanThatFoldsMeetItsOutermostSheet) {
  // A ring seen from inside its tube: half of it lies behind the hole.
  CheckedMesh scan;
  scan.mesh = test::torus(1.0, 0.7, 30);
  scan.report.centroid = {1.0, 0.0, 0.0};
  scan.report.equivalent_radius = 1.3;
  SurfaceOptions options;
  options.parametrization = Parametrization::Radial;
  options.degree = 2;
  options.fold_limit_percent = 99.0;
  const ParametrizationChoice choice =
      choose_parametrization(scan.mesh, scan.report.centroid, options, true, Execution(1));
  ASSERT_GT(choice.folded_share, 0.05);
  const MeshSurface plain(scan.mesh, scan.report.centroid, scan.report.equivalent_radius,
                          Execution(1));
  const Grain grain = grain_of_scan(scan, choice, options, 100, Execution(1));
  ASSERT_TRUE(grain.rays);
  for (const Vector3& u : random_directions(1000, test::announced(1))) {
    // Conditioning of a grazing hit, as down to a hundredth of a radian here.
    ASSERT_NEAR(grain.rays->radius(u), plain.radius(u), 1e-11) << u.transpose();
  }
}

}  // namespace
}  // namespace wscvt
