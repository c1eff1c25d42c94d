// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace wscvt {
namespace {

TEST(NextPrime, IsTheSmallestAbove) {
  EXPECT_EQ(next_prime(1), 2);
  EXPECT_EQ(next_prime(2), 3);
  EXPECT_EQ(next_prime(7), 11);
  EXPECT_EQ(next_prime(119), 127);  // over 121 = 11^2
  // The largest of 31 bits, whose divisors' squares overflow.
  EXPECT_EQ(next_prime(2147483646), 2147483647);
}

TEST(PlasticSequence, EveryStretchIsSpreadEvenly) {
  for (const std::size_t first : {0U, 1U, 977U, 1000000U}) {
    SCOPED_TRACE(first);
    std::array<int, 64> points{};  // of the squares of an 8 x 8 board
    for (std::size_t i = first; i < first + 1280; ++i) {
      const Eigen::Vector2d p = plastic_point(i);
      ASSERT_GE(p.minCoeff(), 0.0);
      ASSERT_LT(p.maxCoeff(), 1.0);
      ++points[8 * static_cast<std::size_t>(8.0 * p.x()) + static_cast<std::size_t>(8.0 * p.y())];
    }
    // 20 each; of random points some square would have 8 or fewer, and some 32 or more.
    const auto [least, most] = std::minmax_element(points.begin(), points.end());
    EXPECT_GE(*least, 16);
    EXPECT_LE(*most, 24);
  }
}

}  // namespace
}  // namespace wscvt
