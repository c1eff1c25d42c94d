// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_facet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wscvt {
namespace {

/// A radial node, whose direction is its position.
RefinementNode radial(const Vector3& position) { return {position, position, {}}; }

/// A triangle of about unit size about (1, 0, 0), turned about an edge through that until its plane
/// passes the origin at `distance`, all times `scale`.
RefinementFacet facet_at(double distance, double scale) {
  // The plane holds (1, 0, 0) and the y direction; its normal has x component `distance`.
  const Vector3 down(std::sqrt(1.0 - distance * distance), 0.0, -distance);
  const Vector3 a = scale * Vector3(1.0, -0.5, 0.0);
  const Vector3 b = scale * Vector3(1.0, 0.5, 0.0);
  const Vector3 c = scale * (Vector3(1.0, 0.0, 0.0) - 0.8 * down);
  return {radial(a), radial(b), radial(c)};
}

TEST(RefinementFacet, IsRefusedWhereItIsNearlyEdgeOnWhateverItsSize) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    // The limit is a thousandth of the longest corner's length, 1.12 here.
    EXPECT_FALSE(facet_at(1.0e-3, scale).counter_clockwise) << scale;
    EXPECT_TRUE(facet_at(1.3e-3, scale).counter_clockwise) << scale;
    EXPECT_FALSE(facet_at(-0.1, scale).counter_clockwise) << scale;
  }
}

TEST(RefinementFacet, KnowsItsPlaneAndSmallestAngle) {
  const RefinementFacet facet(radial({1, 0, 0}), radial({0, 1, 0}), radial({0, 0, 1}));
  EXPECT_NEAR(facet.largest_cosine, 0.5, 1e-15);  // 60 degrees
  EXPECT_NEAR(facet.residual(Vector3(1, 1, 1)), 2.0 / std::sqrt(3.0), 1e-15);
  EXPECT_TRUE(facet.acceptable(cosine_of_degrees(59.9)));
  EXPECT_FALSE(facet.acceptable(cosine_of_degrees(60.1)));
  const RefinementFacet line(radial({1, 0, 0}), radial({1, 1, 0}), radial({1, 2, 0}));
  EXPECT_FALSE(line.acceptable(1.0));
}

TEST(AnglePenalty, FallsToNothingAtItsGoal) {
  const RefinementFacet even(radial({1, 0, 0}), radial({0, 1, 0}), radial({0, 0, 1}));
  RefinementFacet flat = even;
  flat.largest_cosine = 1.0;
  RefinementFacet half = even;
  half.largest_cosine = 0.75;
  const AnglePenalty penalty{0.5, 3.0};
  EXPECT_NEAR(penalty(even), 0.0, 1e-15);
  EXPECT_EQ(penalty(flat), 3.0);
  EXPECT_EQ(penalty(half), 3.0 / 4.0);
  EXPECT_EQ((AnglePenalty{0.5, 0.0}(flat)), 0.0);
}

}  // namespace
}  // namespace wscvt
