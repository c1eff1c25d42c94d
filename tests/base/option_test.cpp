// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/option.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace wscvt {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int no_limit = std::numeric_limits<int>::max();

template <class Number>
std::string refusal(Number value, const NumberOption<Number>& option) {
  try {
    require_in_range(value, option);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    return error.what();
  }
  return "";
}

TEST(Option, HoldsItsEndsUnlessItSaysOtherwise) {
  const NumberOption<int> nodes = {"nodes", "number of nodes", 4, 1000000};
  EXPECT_EQ(refusal(4, nodes), "");
  EXPECT_EQ(refusal(1000000, nodes), "");
  EXPECT_EQ(refusal(3, nodes), "The number of nodes is 3; give a whole number, 4 to 1000000.");
  EXPECT_EQ(refusal(1000001, nodes),
            "The number of nodes is 1000001; give a whole number, 4 to 1000000.");

  const double above_zero = std::numeric_limits<double>::denorm_min();
  const double below_one = std::nextafter(1.0, 0.0);
  const NumberOption<double> open = {"share", "share", 0.0, 1.0, Ends::Neither};
  EXPECT_EQ(refusal(above_zero, open), "");
  EXPECT_EQ(refusal(below_one, open), "");
  EXPECT_EQ(refusal(0.0, open), "The share is 0; give a number, above 0 to below 1.");
  EXPECT_EQ(refusal(1.0, open), "The share is 1; give a number, above 0 to below 1.");
  const NumberOption<double> half_open = {"share", "share", 0.0, 1.0, Ends::NotMaximum};
  EXPECT_EQ(refusal(0.0, half_open), "");
  EXPECT_NE(refusal(1.0, half_open), "");
}

TEST(Option, NeverHoldsWhatIsNoFiniteNumber) {
  const NumberOption<double> any = {"length", "length", -infinity, infinity};
  const NumberOption<double> positive = {"length", "length", 0.0, infinity, Ends::NotMinimum};
  EXPECT_EQ(refusal(1e300, positive), "");
  for (const double value : {std::nan(""), infinity}) {
    EXPECT_NE(refusal(value, any), "");
    EXPECT_NE(refusal(value, positive), "");
  }
  EXPECT_EQ(refusal(infinity, positive), "The length is inf; give a number, above 0.");
}

TEST(Option, TextsSayNothingOfALimitThatThereIsNot) {
  EXPECT_EQ(range_text(NumberOption<int>{"n", "n", 0, no_limit}), "0 or more");
  EXPECT_EQ(range_text(NumberOption<double>{"n", "n", 0.0, infinity, Ends::NotMinimum}), "above 0");
  EXPECT_EQ(range_text(NumberOption<double>{"n", "n", -3.0, 1.5}), "-3 to 1.5");
  const NumberOption<std::uint64_t> seed = {"seed", "seed", 0,
                                            std::numeric_limits<std::uint64_t>::max()};
  EXPECT_EQ(range_text(seed), "0 or more");
  EXPECT_EQ(refusal(std::numeric_limits<std::uint64_t>::max(), seed), "");
}

}  // namespace
}  // namespace wscvt
