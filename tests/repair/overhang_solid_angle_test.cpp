// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/overhang_solid_angle.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace wscvt
