// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/parametrization.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grains/bent_grain.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(Parametrization, GentleFlanksAreNotSteep) {
  EXPECT_EQ(steep_share(test::sphere(3), Execution(1)), 0.0);
  EXPECT_EQ(steep_share(test::box(1.0, 1.0, 1.0), Execution(1)), 0.0);
  // The steepest flank of an ellipsoid has the tangent (a^2 - b^2) / (2 a b): 67 degrees at 5 : 1,
  // 79 degrees at 10 : 1.
  EXPECT_EQ(steep_share(test::scaled(test::sphere(5), Vector3(5, 1, 1)), Execution(1)), 0.0);
  EXPECT_GT(steep_share(test::scaled(test::sphere(5), Vector3(10, 1, 1)), Execution(1)),
            steep_share_limit);
}

TEST(Parametrization, FacesThatLookBackAreSteep) {
  for (const test::BentGrain& grain : test::bent_grains()) {
    EXPECT_GT(steep_share(test::bent_grain_mesh(grain, 6000), Execution(1)), steep_share_limit)
        << grain.name;
  }
}

TEST(Parametrization, TheShareIsThatOfTheArea) {
  // A long square prism about its middle: of each face, what lies beyond tan(75 degrees) times its
  // distance from the axis is steep. Cut fine enough for the middles of faces to tell.
  const double length = 20.0;
  const IndexedMesh prism = test::subdivided(test::box(1.0, 1.0, length), 6);
  const double steep_angle = steep_flank_angle * test::pi / 180.0;
  // On the line along the middle of a face; across it the limit grows by at most a factor sqrt(2).
  const double nearest = 2.0 * 0.5 * std::tan(steep_angle);
  const double upper = 4.0 * (length - nearest) / (4.0 * length + 2.0);
  const double lower = 4.0 * (length - std::sqrt(2.0) * nearest) / (4.0 * length + 2.0);
  const double share = steep_share(prism, Execution(1));
  EXPECT_LT(share, upper + 0.01);
  EXPECT_GT(share, lower - 0.01);
}

TEST(Parametrization, SameBitsOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::scaled(test::lumpy(5), Vector3(8, 1, 1));
  EXPECT_EQ(steep_share(mesh, Execution(1)), steep_share(mesh, Execution(3)));
}

}  // namespace
}  // namespace wscvt
