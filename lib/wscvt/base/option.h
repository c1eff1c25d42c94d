// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

// The names of an enumeration's values are in one table beside the enumeration. Reports, programs,
// dialogs, checks and messages read it, so each value has one name everywhere. A new value needs
// only a new row.

/// A row of a table: one value.
template <class Enumeration>
struct Enumerator {
  Enumeration value;
  std::string_view key;           ///< in commands and files: lower case, words joined by "-"
  std::string_view label;         ///< for people, in the middle of a sentence
  std::string_view meaning = {};  ///< its effect, for help texts; empty if the label says it
};

/// The table of an enumeration, specialised beside it. Has `key` and `subject`, as in NumberOption,
/// and `rows`, an array of Enumerator in the order of the values 0, 1, 2, ...
template <class Enumeration>
struct EnumerationTable;

/// The rows in the order of their values.
template <class Enumeration>
constexpr const auto& enumerators() {
  return EnumerationTable<Enumeration>::rows;
}

/// Whether a table's rows have the values 0, 1, 2, ... and different keys. The functions below rely
/// on it, and so do saved scripts, which store the values as numbers.
template <class Enumeration>
constexpr bool is_table_in_order() {
  std::size_t index = 0;
  for (const auto& row : enumerators<Enumeration>()) {
    if (static_cast<std::size_t>(row.value) != index++) return false;
    for (const auto& other : enumerators<Enumeration>()) {
      if (row.value != other.value && row.key == other.key) return false;
    }
  }
  return true;
}

/// Returns the keys as a choice: "a, b or c".
template <class Enumeration>
std::string keys_of() {
  std::vector<std::string> keys;
  for (const auto& row : enumerators<Enumeration>()) keys.emplace_back(row.key);
  return enumerated(keys, " or ");
}

/// Throws Error(InvalidInput), naming the choices, if a value is not in the table; a cast number
/// may not be.
template <class Enumeration>
void require_valid(Enumeration value) {
  static_assert(is_table_in_order<Enumeration>());
  const auto index = static_cast<long long>(value);
  if (index >= 0 && index < static_cast<long long>(std::size(enumerators<Enumeration>()))) return;
  refuse("Unknown " + std::string(EnumerationTable<Enumeration>::subject) + ": number " +
         std::to_string(index) + ". Give " + keys_of<Enumeration>() + ".");
}

/// Returns the row of a value. Throws as require_valid.
template <class Enumeration>
const Enumerator<Enumeration>& row_of(Enumeration value) {
  require_valid(value);
  return enumerators<Enumeration>()[static_cast<std::size_t>(value)];
}

/// Returns the key of a value. Throws as require_valid.
template <class Enumeration>
std::string key_of(Enumeration value) {
  return std::string(row_of(value).key);
}

/// Returns the label of a value, for people. Throws as require_valid.
template <class Enumeration>
std::string label_of(Enumeration value) {
  return std::string(row_of(value).label);
}

/// Returns the value of a key. Throws Error(InvalidInput), naming the choices, for any other text.
template <class Enumeration>
Enumeration from_key(std::string_view key) {
  static_assert(is_table_in_order<Enumeration>());
  for (const auto& row : enumerators<Enumeration>()) {
    if (row.key == key) return row.value;
  }
  refuse("Unknown " + std::string(EnumerationTable<Enumeration>::subject) + ": \"" +
         std::string(key) + "\". Give " + keys_of<Enumeration>() + ".");
}

// The name and range of an option that is a number or a flag are in one constant beside its struct.
// Reports, programs, dialogs, checks and messages read it too.

/// The ends that belong to a range.
enum class Ends { Both, NotMinimum, NotMaximum, Neither };

/// An option that is a number. The largest number of its type, or infinity, is no limit.
template <class Number>
struct NumberOption {
  std::string_view key;      ///< as in Enumerator
  std::string_view subject;  ///< its name, to follow "The" in a sentence
  Number minimum;
  Number maximum;
  Ends ends = Ends::Both;
  std::string_view meaning = {};  ///< its effect, for help texts; may be empty

  /// Returns whether the value is in the range; false for NaN.
  constexpr bool contains(Number value) const {
    const bool above = excludes_minimum() ? value > minimum : value >= minimum;
    const bool below = excludes_maximum() ? value < maximum : value <= maximum;
    return above && below && (has_maximum() || value <= std::numeric_limits<Number>::max());
  }
  constexpr bool excludes_minimum() const {
    return ends == Ends::NotMinimum || ends == Ends::Neither;
  }
  constexpr bool excludes_maximum() const {
    return ends == Ends::NotMaximum || ends == Ends::Neither;
  }
  constexpr bool has_maximum() const { return maximum < std::numeric_limits<Number>::max(); }
};

/// An option that is on or off.
struct FlagOption {
  std::string_view key;
  std::string_view subject;
  std::string_view meaning;
};

/// Returns a number as a user would type it: as many digits as it needs, and no exponent if a
/// person would write none (see format_typed, text_format.h).
inline std::string typed_text(double value) { return format_typed(value); }

template <class Number>
std::string typed_text(Number value) {
  static_assert(std::is_integral_v<Number>);
  return std::to_string(value);
}

// Mentions of these options in a sentence, see Sentence.
template <class Number>
Sentence mention(const NumberOption<Number>& option) {
  return mention(std::string(option.key));
}
template <class Number>
Sentence mention(const NumberOption<Number>& option, Number value) {
  return mention(std::string(option.key), typed_text(value));
}
inline Sentence mention(const FlagOption& option) {
  return mention(std::string(option.key), "true");
}
template <class Enumeration, class = std::enable_if_t<std::is_enum_v<Enumeration>>>
Sentence mention(Enumeration value) {
  return mention(std::string(EnumerationTable<Enumeration>::key), key_of(value));
}

/// Returns a text with a capital first letter, for the beginning of a sentence.
inline std::string capitalised(std::string_view text) {
  std::string result(text);
  // Not std::toupper, because it depends on the locale.
  if (!result.empty() && result[0] >= 'a' && result[0] <= 'z') {
    result[0] = static_cast<char>(result[0] - 'a' + 'A');
  }
  return result;
}

/// Returns the range as text: "4 to 1000000", "above 0", "0 or more", "0 to below 1", "above 0 and
/// below 2", "above 0 and at most 2".
template <class Number>
std::string range_text(const NumberOption<Number>& option) {
  const std::string minimum = typed_text(option.minimum);
  if (!option.has_maximum()) {
    return option.excludes_minimum() ? "above " + minimum : minimum + " or more";
  }
  const std::string maximum = typed_text(option.maximum);
  if (option.excludes_minimum()) {
    return "above " + minimum + " and " + (option.excludes_maximum() ? "below " : "at most ") +
           maximum;
  }
  return minimum + " to " + (option.excludes_maximum() ? "below " : "") + maximum;
}

/// Returns the message that refuses a value.
template <class Number>
std::string refusal(std::string_view value, const NumberOption<Number>& option) {
  const std::string before = option.excludes_minimum() ? ""
                             : option.has_maximum()    ? "from "
                                                       : "of ";
  return "The " + std::string(option.subject) + " is " + std::string(value) + ". Give " +
         (std::is_integral_v<Number> ? "a whole number " : "a number ") + before +
         range_text(option) + ".";
}

/// Throws Error(InvalidInput), with the range, if a value is out of range or NaN.
template <class Number>
void require_in_range(Number value, const NumberOption<Number>& option) {
  if (option.contains(value)) return;
  refuse(refusal(typed_text(value), option));
}

/// Returns the number that a text contains, the inverse of typed_text. The decimal sign is a point
/// in every locale. Throws Error(InvalidInput), with the range, for any other text and for values
/// out of range.
template <class Number>
Number from_typed(std::string_view text, const NumberOption<Number>& option) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !option.contains(value)) {
    refuse(refusal("\"" + std::string(text) + "\"", option));
  }
  return value;
}

/// The threads of an Execution. They change no result, so reports do not hold them.
inline constexpr NumberOption<int> threads_option = {
    "threads", "number of threads", 0, std::numeric_limits<int>::max(), Ends::Both, "0 for all"};

}  // namespace wscvt
