// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "wscvt/base/lower_case.h"

namespace wscvt {

// Fields of a line of text and the numbers they hold, the same in every locale.

/// The fields of a line, which blanks and tabs separate.
class TextFields {
 public:
  explicit TextFields(std::string_view line) : rest_(line) {}

  /// The next field; empty when there is none.
  std::string_view next() {
    std::size_t begin = 0;
    while (begin < rest_.size() && is_space(rest_[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !is_space(rest_[end])) ++end;
    const std::string_view field = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return field;
  }

  /// What stands after the field read last.
  std::string_view rest() const { return rest_; }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::string_view rest_;
};

/// The number a field holds, whole field, also "nan" and "inf"; nothing when it is none, or one
/// that no double comes near.
std::optional<double> number_in(std::string_view field);

/// The same for whole numbers.
std::optional<std::int64_t> whole_number_in(std::string_view field);

/// One of the two, by the type: double, or any whole number's.
template <class Number>
std::optional<Number> number_of_type(std::string_view field) {
  if constexpr (std::is_same_v<Number, double>) {
    return number_in(field);
  } else {
    return whole_number_in(field);
  }
}

/// A text without the white space at its ends.
std::string_view trimmed(std::string_view text);

/// A field as a sentence shows it: cut when long, without control characters.
std::string shown(std::string_view field);

/// The same in quotes.
std::string in_quotes(std::string_view field);

}  // namespace wscvt
