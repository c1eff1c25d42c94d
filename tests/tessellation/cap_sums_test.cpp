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
  // The radii keep chords and arcs within half a row of each other.
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
      const std::vector<double> sums = sum_over_caps(field, radius, Execution(2));
      const std::vector<double> expected = all_pairs(field, radius);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        // What lies on a cap's edge, to rounding, has weight exp(-2).
        EXPECT_NEAR(sums[i], expected[i], 1e-12 + (filled > 100 ? 1e-11 : 0.0));
      }
    }
  }
}

}  // namespace
}  // namespace wscvt
