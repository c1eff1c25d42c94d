// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/option.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "support/expect_error.h"

namespace wscvt {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int no_limit = std::numeric_limits<int>::max();

template <class Number>
std::string refused(Number value, const NumberOption<Number>& option) {
  return test::refusal(ErrorCode::InvalidInput, [&] { require_in_range(value, option); });
}

TEST(Option, HoldsItsEndsUnlessItSaysOtherwise) {
  const NumberOption<int> nodes = {"nodes", "number of nodes", 4, 1000000};
  EXPECT_EQ(refused(4, nodes), "");
  EXPECT_EQ(refused(1000000, nodes), "");
  EXPECT_EQ(refused(3, nodes), "The number of nodes is 3. Give a whole number from 4 to 1000000.");
  EXPECT_EQ(refused(1000001, nodes),
            "The number of nodes is 1000001. Give a whole number from 4 to 1000000.");

  const double above_zero = std::numeric_limits<double>::denorm_min();
  const double below_one = std::nextafter(1.0, 0.0);
  const NumberOption<double> open = {"share", "share", 0.0, 1.0, Ends::Neither};
  EXPECT_EQ(refused(above_zero, open), "");
  EXPECT_EQ(refused(below_one, open), "");
  EXPECT_EQ(refused(0.0, open), "The share is 0. Give a number above 0 and below 1.");
  EXPECT_EQ(refused(1.0, open), "The share is 1. Give a number above 0 and below 1.");
  const NumberOption<double> half_open = {"share", "share", 0.0, 1.0, Ends::NotMaximum};
  EXPECT_EQ(refused(0.0, half_open), "");
  EXPECT_EQ(refused(1.0, half_open), "The share is 1. Give a number from 0 to below 1.");
}

TEST(Option, NeverHoldsWhatIsNoFiniteNumber) {
  const NumberOption<double> any = {"length", "length", -infinity, infinity};
  const NumberOption<double> positive = {"length", "length", 0.0, infinity, Ends::NotMinimum};
  EXPECT_EQ(refused(1e300, positive), "");
  for (const double value : {std::nan(""), infinity}) {
    EXPECT_NE(refused(value, any), "");
    EXPECT_NE(refused(value, positive), "");
  }
  EXPECT_EQ(refused(infinity, positive), "The length is inf. Give a number above 0.");
}

TEST(Option, TextsSayNothingOfALimitThatThereIsNot) {
  EXPECT_EQ(range_text(NumberOption<int>{"n", "n", 0, no_limit}), "0 or more");
  EXPECT_EQ(range_text(NumberOption<double>{"n", "n", 0.0, infinity, Ends::NotMinimum}), "above 0");
  EXPECT_EQ(range_text(NumberOption<double>{"n", "n", -3.0, 1.5}), "-3 to 1.5");
  EXPECT_EQ(range_text(NumberOption<double>{"n", "n", 0.0, 1.5, Ends::NotMinimum}),
            "above 0 and at most 1.5");
  const NumberOption<std::uint64_t> seed = {"seed", "seed", 0,
                                            std::numeric_limits<std::uint64_t>::max()};
  EXPECT_EQ(range_text(seed), "0 or more");
  EXPECT_EQ(refused(-1, NumberOption<int>{"n", "n", 0, no_limit}),
            "The n is -1. Give a whole number of 0 or more.");
  EXPECT_EQ(refused(std::numeric_limits<std::uint64_t>::max(), seed), "");
}

template <class Number>
std::string text_refused(const std::string& text, const NumberOption<Number>& option) {
  return test::refusal(ErrorCode::InvalidInput, [&] { from_typed(text, option); });
}

TEST(Option, ReadsWhatOneTypesAndNothingElse) {
  const NumberOption<int> nodes = {"nodes", "number of nodes", 4, 1000000};
  const NumberOption<double> alpha = {"alpha", "alpha", -3.0, 3.0};
  EXPECT_EQ(from_typed("1000000", nodes), 1000000);
  EXPECT_EQ(from_typed("-2.5e-1", alpha), -0.25);
  EXPECT_EQ(from_typed("18446744073709551615",
                       NumberOption<std::uint64_t>{"seed", "seed", 0,
                                                   std::numeric_limits<std::uint64_t>::max()}),
            std::numeric_limits<std::uint64_t>::max());
  for (const std::string text : {"", "many", "4.5", "12 ", " 12", "12nodes", "3", "99999999999"}) {
    EXPECT_EQ(text_refused(text, nodes),
              "The number of nodes is \"" + text + "\". Give a whole number from 4 to 1000000.");
  }
  for (const std::string text : {"nan", "inf", "0,5", "3.0000001", "0x1"}) {
    EXPECT_EQ(text_refused(text, alpha),
              "The alpha is \"" + text + "\". Give a number from -3 to 3.");
  }
}

TEST(Option, TypedNumbersComeBackToTheLastBit) {
  const NumberOption<double> any = {"any", "any", -infinity, infinity};
  for (const double value : {2.0 / 3.0, 0.07, 1e-300, -123456.789, 1e15}) {
    EXPECT_EQ(from_typed(typed_text(value), any), value);
  }
}

TEST(Option, CapitalisesTheFirstLetterOnly) {
  EXPECT_EQ(capitalised("one Two"), "One Two");
  EXPECT_EQ(capitalised("WSCVT-D"), "WSCVT-D");
  EXPECT_EQ(capitalised("4 nodes"), "4 nodes");
  EXPECT_EQ(capitalised(""), "");
}

}  // namespace

namespace {

enum class Fruit { Apple, Pear, Plum };
enum class Swapped { One, Two };
enum class Doubled { One, Two };

}  // namespace

template <>
struct EnumerationTable<Fruit> {
  static constexpr std::string_view key = "fruit";
  static constexpr std::string_view subject = "fruit in the basket";
  static constexpr Enumerator<Fruit> rows[] = {{Fruit::Apple, "apple", "apple of the garden"},
                                               {Fruit::Pear, "pear", "pear", "juicy"},
                                               {Fruit::Plum, "sweet-plum", "sweet plum"}};
};

template <>
struct EnumerationTable<Swapped> {
  static constexpr Enumerator<Swapped> rows[] = {{Swapped::Two, "two", ""},
                                                 {Swapped::One, "one", ""}};
};

template <>
struct EnumerationTable<Doubled> {
  static constexpr Enumerator<Doubled> rows[] = {{Doubled::One, "one", ""},
                                                 {Doubled::Two, "one", ""}};
};

namespace {

/// The sentence of the Error that a call throws, after its code was checked.
template <class Call>
std::string sentence_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(Enumeration, KeysAndLabelsGoThereAndBack) {
  EXPECT_EQ(key_of(Fruit::Plum), "sweet-plum");
  EXPECT_EQ(label_of(Fruit::Apple), "apple of the garden");
  EXPECT_EQ(row_of(Fruit::Pear).meaning, "juicy");
  EXPECT_EQ(keys_of<Fruit>(), "apple, pear or sweet-plum");
  for (const Enumerator<Fruit>& row : enumerators<Fruit>()) {
    EXPECT_EQ(from_key<Fruit>(row.key), row.value);
    EXPECT_NO_THROW(require_valid(row.value));
  }
}

TEST(Enumeration, RefusesWhatTheTableDoesNotHoldAndNamesTheChoices) {
  for (const std::string key : {"Apple", "apple of the garden", "", "0", "app", "apples"}) {
    const std::string sentence = sentence_of([&] { from_key<Fruit>(key); });
    EXPECT_EQ(sentence,
              "Unknown fruit in the basket: \"" + key + "\". Give apple, pear or sweet-plum.");
  }
  for (const int number : {-1, 3, 1000}) {
    const auto none = static_cast<Fruit>(number);
    const std::string sentence = "Unknown fruit in the basket: number " + std::to_string(number) +
                                 ". Give apple, pear or sweet-plum.";
    EXPECT_EQ(sentence_of([&] { require_valid(none); }), sentence);
    EXPECT_EQ(sentence_of([&] { key_of(none); }), sentence);
    EXPECT_EQ(sentence_of([&] { label_of(none); }), sentence);
  }
}

TEST(Enumeration, ATableOutOfOrderOrWithOneKeyTwiceIsFoundOut) {
  EXPECT_TRUE(is_table_in_order<Fruit>());
  EXPECT_FALSE(is_table_in_order<Swapped>());
  EXPECT_FALSE(is_table_in_order<Doubled>());
}

}  // namespace
}  // namespace wscvt
