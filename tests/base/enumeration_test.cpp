// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>

#include "wscvt/base/option.h"

namespace wscvt {
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
    EXPECT_TRUE(is_valid(row.value));
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
    EXPECT_FALSE(is_valid(none));
    const std::string sentence = "Unknown fruit in the basket: number " + std::to_string(number) +
                                 ". Give apple, pear or sweet-plum.";
    EXPECT_EQ(sentence_of([&] { require_valid(none); }), sentence);
    EXPECT_EQ(sentence_of([&] { key_of(none); }), sentence);
    EXPECT_EQ(sentence_of([&] { label_of(none); }), sentence);
  }
  EXPECT_NO_THROW(require_valid(Fruit::Plum));
}

TEST(Enumeration, ATableOutOfOrderOrWithOneKeyTwiceIsFoundOut) {
  EXPECT_TRUE(is_table_in_order<Fruit>());
  EXPECT_FALSE(is_table_in_order<Swapped>());
  EXPECT_FALSE(is_table_in_order<Doubled>());
}

}  // namespace
}  // namespace wscvt
