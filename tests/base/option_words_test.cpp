// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/option_words.h"

#include <gtest/gtest.h>

#include <string>

namespace wscvt {
namespace {

std::string in_capitals(std::string_view key) { return "<" + std::string(key) + ">"; }

TEST(OptionWords, NamesOfOptionsAreReplacedAndNothingElse) {
  EXPECT_EQ(with_option_names("Raise --max-overhang, or use --points.", in_capitals),
            "Raise <max-overhang>, or use <points>.");
  EXPECT_EQ(with_option_names("--degree", in_capitals), "<degree>");
  EXPECT_EQ(with_option_names("--handles-", in_capitals), "<handles>-");
  for (const char* text : {"", "--", "a-b", "a -- b", "ends in --", "---", "-x", "1--2"}) {
    EXPECT_EQ(with_option_names(text, in_capitals), text);
  }
}

}  // namespace
}  // namespace wscvt
