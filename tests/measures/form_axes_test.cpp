// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/form_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "support/cancelled_runs.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

TEST(FormAxes, BoxInAnyPoseHasItsOwnEdges) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const IndexedMesh mesh =
        test::transformed(test::box(1, 2, 3), test::random_rotation(seed), {10, -20, 30});
    const FormAxes axes = oriented_box_axes(mesh.points);
    // The optimisation ends with steps of 1e-11.
    EXPECT_NEAR(axes.shortest, 1.0, 1e-9);
    EXPECT_NEAR(axes.intermediate, 2.0, 1e-9);
    EXPECT_NEAR(axes.longest, 3.0, 1e-9);
  }
}

TEST(FormAxes, EllipsoidHasItsAxes) {
  // 162 points; above 2,000 the box is turned by extreme points only, tried with 2562. The box
  // of smallest volume is known to the optimisation's stop rule and the thinning, both below 0.2 %,
  // and the mesh by its chords.
  for (const int times : {2, 4}) {
    SCOPED_TRACE(times);
    const FormAxes axes =
        oriented_box_axes(test::transformed(test::scaled(test::sphere(times), {0.5, 0.75, 1.0}),
                                            test::random_rotation(test::announced(11)))
                              .points);
    EXPECT_NEAR(axes.shortest, 1.0, times == 2 ? 5e-2 : 5e-3);
    EXPECT_NEAR(axes.intermediate, 1.5, times == 2 ? 5e-2 : 5e-3);
    EXPECT_NEAR(axes.longest, 2.0, times == 2 ? 5e-2 : 5e-3);
  }
}

TEST(FormAxes, NeverLargerThanTheAxisAlignedBox) {
  const IndexedMesh mesh = test::lumpy(2);
  Vector3 lower = mesh.points[0];
  Vector3 upper = lower;
  for (const Vector3& p : mesh.points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const FormAxes axes = oriented_box_axes(mesh.points);
  EXPECT_LE(axes.shortest * axes.intermediate * axes.longest, (upper - lower).prod());
  EXPECT_LE(axes.shortest, axes.intermediate);
  EXPECT_LE(axes.intermediate, axes.longest);
}

/// Points of a lattice in a pose: many lie on the edges and sides of their hull, which has more
/// than one triangulation.
std::vector<Vector3> turned_lattice() {
  std::vector<Vector3> points;
  const Eigen::Matrix3d turn = test::random_rotation(test::announced(3));
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 5; ++j) {
      for (int k = 0; k < 4; ++k) points.emplace_back(turn * Vector3(i, j, k));
    }
  }
  return points;
}

TEST(FormAxes, SameBitsEveryTimeWhereverMemoryLies) {
  for (const std::vector<Vector3>& points : {test::lumpy(2).points, turned_lattice()}) {
    const FormAxes first = oriented_box_axes(points);
    std::mt19937 random(5);
    std::vector<std::unique_ptr<char[]>> blocks(2000);
    for (int time = 0; time < 3; ++time) {
      // Free blocks of all sizes in no order: what is allocated next lies in none either.
      for (auto& block : blocks) {
        if (random() % 2 == 0) block = std::make_unique<char[]>(8 + random() % 600);
      }
      for (auto& block : blocks) {
        if (random() % 2 == 0) block.reset();
      }
      const FormAxes again = oriented_box_axes(points);
      EXPECT_EQ(first.shortest, again.shortest);
      EXPECT_EQ(first.intermediate, again.intermediate);
      EXPECT_EQ(first.longest, again.longest);
    }
  }
}

TEST(FormAxes, StopsWhenAskedTo) {
  // Once a direction in which the extreme point is looked for, and once a turn tried.
  const std::vector<Vector3> points = test::lumpy(5).points;
  test::expect_to_be_stopped(
      [&](const Execution& execution) { oriented_box_axes(points, execution); },
      "Turning the bounding box", 2000 + 500);
}

TEST(FormAxes, RefusesWhatHasNoBox) {
  EXPECT_ERROR(oriented_box_axes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), InvalidInput);
  // The exact numbers in CGAL ended the program at these.
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    std::vector<Vector3> points = test::lumpy(1).points;
    points[5].y() = bad;
    EXPECT_ERROR(oriented_box_axes(points), InvalidInput);
  }
}

TEST(FormRatios, FollowTheirFormulas) {
  const FormRatios r = form_ratios({1.0, 2.0, 4.0});
  EXPECT_DOUBLE_EQ(r.aspect_ratio, 0.25);
  EXPECT_DOUBLE_EQ(r.zingg_elongation, 0.5);
  EXPECT_DOUBLE_EQ(r.zingg_flatness, 0.5);
  EXPECT_DOUBLE_EQ(r.kong_fonseca_elongation, 0.5);
  EXPECT_DOUBLE_EQ(r.kong_fonseca_flatness, 0.5);
  EXPECT_DOUBLE_EQ(r.krumbein_sphericity, 0.5);
  const FormRatios cube = form_ratios({3.0, 3.0, 3.0});
  EXPECT_DOUBLE_EQ(cube.aspect_ratio, 1.0);
  EXPECT_DOUBLE_EQ(cube.kong_fonseca_elongation, 0.0);
  EXPECT_DOUBLE_EQ(cube.kong_fonseca_flatness, 0.0);
  EXPECT_DOUBLE_EQ(cube.krumbein_sphericity, 1.0);
}

}  // namespace
}  // namespace wscvt
