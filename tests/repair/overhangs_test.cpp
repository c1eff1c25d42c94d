// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/overhangs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grains/bent_grain.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

using test::box;
using test::joined;
using test::moved;
using test::sphere;
using test::torus;

TEST(FoldedSolidAngle, IsZeroForAStarShapedMesh) {
  for (const IndexedMesh& mesh : {sphere(3), box(1, 1, 1), test::lumpy(4)}) {
    EXPECT_EQ(overhang_solid_angle(mesh, Vector3(0.1, 0.05, -0.1), Execution(1)), 0.0);
  }
}

TEST(FoldedSolidAngle, CountsTheSheetsBeyondTheFirst) {
  // A box with a second one hung over a face on a shaft: seen from the centre of the first, the
  // faces of the bump that look back are those of a plate beside the shaft. Here the plate is a
  // separate closed body outside, which adds its outline twice: 2 (solid angle of its near face).
  const double half = 0.5;
  const double distance = 3.0;
  const IndexedMesh plate = moved(box(2 * half, 2 * half, 1e-9), 1.0, {0, 0, distance});
  const IndexedMesh mesh = joined(sphere(3), plate);
  // Solid angle of a square of half side a at distance d: 4 asin(a^2 / (a^2 + d^2)).
  const double outline = 4.0 * std::asin(half * half / (half * half + distance * distance));
  EXPECT_NEAR(overhang_solid_angle(mesh, Vector3::Zero(), Execution(1)),
              2.0 * outline / (4.0 * test::pi), 1e-8);
}

TEST(FoldedSolidAngle, IsAtLeastOneFromOutside) {
  for (const Vector3& centre : {Vector3(5, 0, 0), Vector3(0, 0, -1.01), Vector3(1, 1, 1)}) {
    EXPECT_GE(overhang_solid_angle(sphere(3), centre, Execution(1)), 1.0);
  }
  EXPECT_GE(overhang_solid_angle(box(1, 1, 1), Vector3(0.5, 0.1, 0.2), Execution(1)), 1.0);
}

TEST(FoldedSolidAngle, DoesNotDependOnPlaceSizeAndThreads) {
  const IndexedMesh mesh = torus(1.0, 0.7, 50);
  const Vector3 centre(1.0, 0.0, 0.0);
  const double fold = overhang_solid_angle(mesh, centre, Execution(1));
  EXPECT_GT(fold, 0.01);
  EXPECT_EQ(overhang_solid_angle(mesh, centre, Execution(3)), fold);
  const Vector3 offset(1e6, 0, -1e6);
  // Positions there carry 1e-10.
  EXPECT_NEAR(overhang_solid_angle(moved(mesh, 1.0, offset), centre + offset, Execution(1)), fold,
              1e-7);
  EXPECT_NEAR(overhang_solid_angle(moved(mesh, 1e-6, {0, 0, 0}), 1e-6 * centre, Execution(1)), fold,
              1e-12);
}

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
