// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/steep_area.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grains/bent_grain.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(SteepArea, GentleFlanksAreNotSteep) {
  EXPECT_EQ(steep_area_fraction(test::sphere(3), Vector3::Zero(), Execution(1)), 0.0);
  EXPECT_EQ(steep_area_fraction(test::box(1.0, 1.0, 1.0), Vector3::Zero(), Execution(1)), 0.0);
  // The steepest flank of an ellipsoid has the tangent (a^2 - b^2) / (2 a b): 67 degrees at 5 : 1,
  // 79 degrees at 10 : 1.
  EXPECT_EQ(steep_area_fraction(test::scaled(test::sphere(5), Vector3(5, 1, 1)), Vector3::Zero(),
                                Execution(1)),
            0.0);
  EXPECT_GT(steep_area_fraction(test::scaled(test::sphere(5), Vector3(10, 1, 1)), Vector3::Zero(),
                                Execution(1)),
            0.005);
}

TEST(SteepArea, FacesThatLookBackAreSteep) {
  for (const test::BentGrain& grain : test::bent_grains()) {
    EXPECT_GT(
        steep_area_fraction(test::bent_grain_mesh(grain, 6000), Vector3::Zero(), Execution(1)),
        0.005)
        << grain.name;
  }
}

TEST(SteepArea, TheFractionIsThatOfTheArea) {
  // A long square prism about its middle: of each face, what lies beyond tan(75 degrees) times its
  // distance from the axis is steep. Cut fine enough for the middles of faces to tell.
  const double length = 20.0;
  const IndexedMesh prism = test::subdivided(test::box(1.0, 1.0, length), 6);
  const double limit = steep_angle * test::pi / 180.0;
  // On the line along the middle of a face; across it the limit grows by at most a factor sqrt(2).
  const double nearest = 2.0 * 0.5 * std::tan(limit);
  const double upper = 4.0 * (length - nearest) / (4.0 * length + 2.0);
  const double lower = 4.0 * (length - std::sqrt(2.0) * nearest) / (4.0 * length + 2.0);
  const double share = steep_area_fraction(prism, Vector3::Zero(), Execution(1));
  EXPECT_LT(share, upper + 0.01);
  EXPECT_GT(share, lower - 0.01);
}

TEST(SteepArea, SameBitsOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::scaled(test::lumpy(5), Vector3(8, 1, 1));
  EXPECT_EQ(steep_area_fraction(mesh, Vector3::Zero(), Execution(1)),
            steep_area_fraction(mesh, Vector3::Zero(), Execution(3)));
}

TEST(SteepArea, SeenFromTheCentreGiven) {
  const IndexedMesh mesh = test::scaled(test::lumpy(4), Vector3(8, 1, 1));
  const Vector3 shift(0.5, -3.0, 2.0);
  IndexedMesh moved = mesh;
  for (Vector3& p : moved.points) p += shift;
  EXPECT_NEAR(steep_area_fraction(moved, shift, Execution(1)),
              steep_area_fraction(mesh, Vector3::Zero(), Execution(1)),
              1e-3);  // faces at the limit
}

}  // namespace
}  // namespace wscvt
