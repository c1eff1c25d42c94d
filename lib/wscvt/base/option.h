// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "wscvt/base/enumeration.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

// What an option is called and what it may be, in one constant beside its struct. Checks,
// reports, the program, dialogs and messages all read it.

/// Which ends of a range belong to it.
enum class Ends { Both, NotMinimum, NotMaximum, Neither };

/// An option that is a number. The largest number of its type, or infinity, is no limit.
template <class Number>
struct NumberOption {
  std::string_view key;      ///< what one types, as of an Enumerator
  std::string_view subject;  ///< what it is, to follow "The" in a sentence
  Number minimum;
  Number maximum;
  Ends ends = Ends::Both;
  std::string_view meaning = {};  ///< what it does, for help texts; may be empty

  /// False for what is not a number.
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

/// A number as one types it: every digit it needs, none that it does not, and no exponent where a
/// person would write none.
template <class Number>
std::string typed_text(Number value) {
  if constexpr (std::is_floating_point_v<Number>) {
    return format_typed(value);
  } else {
    return std::to_string(value);
  }
}

/// The range: "4 to 1000000", "above 0", "0 or more", "0 to below 1", "above 0 and below 2".
template <class Number>
std::string range_text(const NumberOption<Number>& option) {
  const std::string minimum = typed_text(option.minimum);
  if (!option.has_maximum()) {
    return option.excludes_minimum() ? "above " + minimum : minimum + " or more";
  }
  return (option.excludes_minimum() ? "above " + minimum + " and " : minimum + " to ") +
         (option.excludes_maximum() ? "below " : "") + typed_text(option.maximum);
}

/// The sentence that refuses a value.
template <class Number>
std::string refusal(std::string_view value, const NumberOption<Number>& option) {
  const std::string before = option.excludes_minimum() ? ""
                             : option.has_maximum()    ? "from "
                                                       : "of ";
  return "The " + std::string(option.subject) + " is " + std::string(value) + "; give " +
         (std::is_integral_v<Number> ? "a whole number " : "a number ") + before +
         range_text(option) + ".";
}

/// Throws Error(InvalidInput), with the range, for a value outside of it or not a number.
template <class Number>
void require_in_range(Number value, const NumberOption<Number>& option) {
  if (option.contains(value)) return;
  throw Error(ErrorCode::InvalidInput, refusal(typed_text(value), option));
}

/// The value of a text, the way back from typed_text; the decimal sign is a point in every locale.
/// Throws Error(InvalidInput), with the range, for any other text and for values outside of it.
template <class Number>
Number from_typed(std::string_view text, const NumberOption<Number>& option) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !option.contains(value)) {
    throw Error(ErrorCode::InvalidInput, refusal("\"" + std::string(text) + "\"", option));
  }
  return value;
}

}  // namespace wscvt
