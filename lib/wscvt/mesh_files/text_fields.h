// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "wscvt/base/text.h"

namespace wscvt {

// Reads the fields of a line of text and their numbers, independent of the locale.

inline bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The fields of a line, separated by blanks and tabs.
class TextFields {
 public:
  explicit TextFields(std::string_view line) : rest_(line) {}

  /// Returns the next field; empty at the end.
  std::string_view next() {
    std::size_t begin = 0;
    while (begin < rest_.size() && is_blank(rest_[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !is_blank(rest_[end])) ++end;
    const std::string_view field = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return field;
  }

  /// Returns the text after the field read last.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// Returns the number that the whole field contains, also "nan" and "inf". Returns nothing if the
/// field is no number or is out of range of a double.
std::optional<double> number_in(std::string_view field);

/// Returns the whole number that the field contains, or nothing.
std::optional<std::int64_t> whole_number_in(std::string_view field);

/// Calls number_in or whole_number_in, by the type: double or any integer.
template <class Number>
std::optional<Number> number_of_type(std::string_view field) {
  if constexpr (std::is_same_v<Number, double>) {
    return number_in(field);
  } else {
    return whole_number_in(field);
  }
}

/// Returns a text without the white space at its ends.
std::string_view trimmed(std::string_view text);

/// Returns the first of `separators` that a line has outside quotes; '\0' if it has none of them.
char separator_in(std::string_view line, std::string_view separators);

/// Splits a line at its semicolons, or else its commas, or else its blanks and tabs; none within
/// quotes. Fields have neither quotes nor blanks at their ends. One may be empty, but not between
/// blanks: there only that of a line without any.
void split_fields(std::string_view line, std::vector<std::string_view>& fields);

/// Returns the number in a field of split_fields. Between semicolons its mark may be a comma.
std::optional<double> number_in_row(std::string_view field, std::string_view line);

/// Returns whether a line names the separator of those below, "sep=;", as spreadsheets write it
/// above a heading.
bool names_separator(std::string_view line);

/// Returns a field for a message: shortened if long, without control characters.
std::string shown(std::string_view field);

/// Returns `shown` in quotes.
std::string in_quotes(std::string_view field);

}  // namespace wscvt
