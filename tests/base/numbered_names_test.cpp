// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/numbered_names.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>

namespace wscvt {
namespace {

int sign(int value) { return (value > 0) - (value < 0); }

TEST(NumberedNames, NumbersAscendByTheirValues) {
  // The order of the manual of strverscmp, and slices.
  const std::string ascending[] = {"000", "00", "01", "010", "09", "0", "1", "9", "10"};
  for (const std::string& a : ascending) {
    for (const std::string& b : ascending) {
      EXPECT_EQ(sign(compare_numbered(a, b)), (&a > &b) - (&a < &b)) << a << " and " << b;
    }
  }
  EXPECT_LT(compare_numbered("slice9.tif", "slice10.tif"), 0);
  EXPECT_LT(compare_numbered("a2b10", "a10b2"), 0);
}

#ifdef __GLIBC__
TEST(NumberedNames, RandomNamesCompareAsGnuDoes) {
  const unsigned seed = 51;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 engine(seed);
  // Few letters, so that beginnings are often equal; one is above 127.
  const std::string letters = "0019.a\xc3";
  const auto name = [&] {
    std::string text(engine() % 8, ' ');
    for (char& letter : text) letter = letters[engine() % letters.size()];
    return text;
  };
  for (int k = 0; k < 200000; ++k) {
    const std::string a = name();
    const std::string b = name();
    ASSERT_EQ(sign(compare_numbered(a, b)), sign(::strverscmp(a.c_str(), b.c_str())))
        << a << " and " << b;
  }
}
#endif

}  // namespace
}  // namespace wscvt
