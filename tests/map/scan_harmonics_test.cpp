// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/scan_harmonics.h"

#include <gtest/gtest.h>

#include <string>

#include "grains/bent_grain.h"
#include "support/test_shapes.h"
#include "wscvt/remesh.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {
namespace {

IndexedMesh body(const std::string& name) {
  return test::bent_grain_mesh(test::bent_grain(name), 2500);
}

TEST(ScanHarmonics, GiveTheBodyAgain) {
  RemeshOptions options;
  options.node_count = 400;
  options.measures.series = scan_harmonics;
  const RemeshResult hook = remesh(body("hook"), options, Execution(1));
  EXPECT_TRUE(hook.coefficients.radius.empty());
  ASSERT_EQ(hook.coefficients.map[0].size(), 441U);  // degree 20
  const RemeshResult again = remesh(HarmonicMap(hook.coefficients.map), options, Execution(1));
  EXPECT_EQ(again.mesh.points.size(), 400U);
  EXPECT_EQ(again.input.genus, 0);
  // The series is an approximation: rms .7 to 2.5 % at degree 20 on such bodies.
  EXPECT_NEAR(again.input.volume / hook.input.volume, 1.0, 0.05);
}

TEST(ScanHarmonics, AreOfTheRadiusWhereRaysSeeAll) {
  // Nor do rays see all of a body with small overhangs, 4 % of all directions.
  const SeriesCoefficients aggregate = scan_harmonics(body("aggregate"), 8, Execution(1));
  EXPECT_TRUE(aggregate.radius.empty());
  EXPECT_EQ(aggregate.map[2].size(), 81U);
  const SeriesCoefficients gentle = scan_harmonics(test::lumpy(4), 8, Execution(1));
  EXPECT_EQ(gentle.radius.size(), 81U);
  EXPECT_TRUE(gentle.map[0].empty());
}

}  // namespace
}  // namespace wscvt
