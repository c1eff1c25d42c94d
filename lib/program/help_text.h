// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "wscvt/base/option.h"

namespace wscvt::program {

/// Columns of the help that hold the options' names; their texts follow.
inline constexpr int help_column = 30;

/// Breaks a text between words so that it fits beside the names on a line of 100 characters.
std::string wrapped(std::string_view text);

/// "Number of nodes, of the remesh: 4 to 1000000. Default: 1000".
template <class Number>
std::string help_of(Number value, const NumberOption<Number>& option) {
  std::string text = capitalised(option.subject) + ", " + range_text(option);
  if (!option.meaning.empty()) text += ": " + std::string(option.meaning);
  return wrapped(text + ". Default: " + typed_text(value));
}

inline std::string help_of(bool value, const FlagOption& option) {
  return wrapped(capitalised(option.subject) + " " + std::string(option.meaning) +
                 (value ? ". Default: on" : ""));
}

/// The subject, the default, and every value with its meaning on a line of its own.
template <class Enumeration>
std::string help_of(Enumeration value) {
  std::string text = capitalised(EnumerationTable<Enumeration>::subject);
  text += ". Default: " + key_of(value);
  for (const Enumerator<Enumeration>& row : enumerators<Enumeration>()) {
    const std::string_view meaning = row.meaning.empty() ? row.label : row.meaning;
    text.append("\n").append(wrapped(std::string(row.key) + ": " + std::string(meaning)));
  }
  return text;
}

}  // namespace wscvt::program
