// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/next_prime.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace wscvt
