// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/sentence.h"

#include <gtest/gtest.h>

#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/option.h"

namespace wscvt {
namespace {

std::string in_brackets(const NamedOption& option) {
  return "<" + option.key + "|" + option.value + ">";
}

TEST(Sentence, SaysItsOptionsInTheWordsOfEachDoor) {
  const Sentence sentence = "Raise " + mention("max-overhang", "30") + ", or set " +
                            mention("points", "true") + " (or " + mention("degree") + ").";
  EXPECT_EQ(sentence.text(), "Raise --max-overhang 30, or set --points (or --degree).");
  EXPECT_EQ(sentence.in(in_brackets),
            "Raise <max-overhang|30>, or set <points|true> (or <degree|>).");
  // Joined to others, also to itself, and without options.
  Sentence twice = "A. " + sentence;
  twice += twice;
  EXPECT_EQ(twice.in(in_brackets),
            "A. " + sentence.in(in_brackets) + "A. " + sentence.in(in_brackets));
  EXPECT_EQ(Sentence("a--b --c").in(in_brackets), "a--b --c");
  EXPECT_EQ(mention("degree").in(in_brackets), "<degree|>");
  EXPECT_TRUE(Sentence().empty());
}

TEST(Sentence, NamesOptionsByTheirTables) {
  constexpr NumberOption<double> ratio = {"edge-ratio", "mean edge ratio", 1.0, 2.0};
  constexpr FlagOption flag = {"points", "ignore faces", ""};
  EXPECT_EQ(mention(ratio).in(in_brackets), "<edge-ratio|>");
  EXPECT_EQ(mention(ratio, 1.4).in(in_brackets), "<edge-ratio|1.4>");
  EXPECT_EQ(mention(flag).in(in_brackets), "<points|true>");
}

TEST(Sentence, OfAnErrorKeepsItsOptions) {
  try {
    refuse("Use " + mention("handles", "cut") + ".");
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "Use --handles cut.");
    const Error again(error.code(), "scan.ply: " + error.sentence());
    EXPECT_EQ(again.sentence().in(in_brackets), "scan.ply: Use <handles|cut>.");
  }
}

}  // namespace
}  // namespace wscvt
