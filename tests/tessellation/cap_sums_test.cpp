// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/cap_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/seeds.h"

namespace wscvt {
namespace {

constexpr int rows = 24;

/// The sum as it is defined, over all pairs of nodes.
std::vector<double> all_pairs(const GridField& field, double radius) {
  const std::vector<Vector3> nodes = SphereGrid::directions(rows);
  std::vector<double> sums(nodes.size(), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double square = (nodes[i] - nodes[k]).squaredNorm();
      if (square > radius * radius && i != k) continue;
      // Rows further apart than the radius along the meridian are left out.
      sums[i] += field.values[k] * std::exp(-2.0 * square / (radius * radius));
    }
  }
  return sums;
}

TEST(CapSums, AreTheSumsOverAllPairs) {
  // Few nodes filled, which are spread, and many, which are gathered; both agree with the
  // definition. The radii keep chords and arcs within half a row of each other.
  std::mt19937_64 engine(test::announced(17));
  std::uniform_real_distribution<double> value(0.5, 2.0);
  for (const int filled : {5, 40, 1152}) {
    for (const double radius : {0.2, 0.3}) {
      GridField field(rows);
      for (int i = 0; i < filled; ++i) {
        field
            .values[filled == 1152 ? static_cast<std::size_t>(i) : engine() % field.values.size()] =
            value(engine);
      }
      const CapSums caps = sum_over_caps(field, radius, Execution(2));
      const std::vector<double> expected = all_pairs(field, radius);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        // What lies on a cap's edge, to rounding, has weight exp(-2).
        EXPECT_NEAR(caps.sums[i], expected[i], 1e-12 + (filled > 100 ? 1e-11 : 0.0));
      }
    }
  }
}

TEST(CapSums, CostWhatTheFieldHolds) {
  // A dozen samples and caps of the whole sphere: every sample meets every node once, not every
  // node every other, which took a second.
  GridField field(128);
  for (std::size_t i = 0; i < 12; ++i) field.values[i * 2711] = 1.0;
  const CapSums caps = sum_over_caps(field, 2.0, Execution(1));
  EXPECT_GT(caps.terms, 0U);
  EXPECT_LE(caps.terms, 12 * field.values.size());
  EXPECT_EQ(sum_over_caps(GridField(128), 2.0, Execution(1)).terms, 0U);
}

}  // namespace
}  // namespace wscvt
