// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

#include "wscvt/base/error.h"

namespace wscvt {

// What the values of an enumeration are called, in one table beside the enumeration. Reports,
// programs, dialogs, checks and messages all read it, so that a value has one name everywhere and a
// new one is a row.

/// A row of a table: one value.
template <class Enumeration>
struct Enumerator {
  Enumeration value;
  std::string_view key;    ///< what one types and what files hold: lower case, words joined by "-"
  std::string_view label;  ///< what a person reads, in the middle of a sentence
  std::string_view meaning = {};  ///< what it does, for help texts; empty where the label says it
};

/// The table of an enumeration; specialised beside it with `key` and `subject`, as in
/// NumberOption, and `rows`, an array of Enumerator in the order of the values 0, 1, 2, ...
template <class Enumeration>
struct EnumerationTable;

/// The rows in the order of their values.
template <class Enumeration>
constexpr const auto& enumerators() {
  return EnumerationTable<Enumeration>::rows;
}

/// Whether a table's rows hold the values 0, 1, 2, ... and keys of their own: what the functions
/// below and saved scripts, which hold the values as numbers, rely on.
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

/// Whether a value is one of the table's; a cast number may be none.
template <class Enumeration>
constexpr bool is_valid(Enumeration value) {
  static_assert(is_table_in_order<Enumeration>());
  const auto index = static_cast<long long>(value);
  return index >= 0 && index < static_cast<long long>(std::size(enumerators<Enumeration>()));
}

/// The keys as a choice: "a, b or c".
template <class Enumeration>
std::string keys_of() {
  std::string text;
  const auto& rows = enumerators<Enumeration>();
  std::size_t left = std::size(rows);
  for (const auto& row : rows) {
    text.append(text.empty() ? "" : left == 1 ? " or " : ", ").append(row.key);
    --left;
  }
  return text;
}

/// Throws Error(InvalidInput), naming the choices, for a value that is not the table's.
template <class Enumeration>
void require_valid(Enumeration value) {
  if (is_valid(value)) return;
  throw Error(ErrorCode::InvalidInput,
              "The " + std::string(EnumerationTable<Enumeration>::subject) + " is number " +
                  std::to_string(static_cast<long long>(value)) + ", which there is not; give " +
                  keys_of<Enumeration>() + ".");
}

/// The row of a value. Throws as require_valid.
template <class Enumeration>
const Enumerator<Enumeration>& row_of(Enumeration value) {
  require_valid(value);
  return enumerators<Enumeration>()[static_cast<std::size_t>(value)];
}

/// What one types for a value. Throws as require_valid.
template <class Enumeration>
std::string key_of(Enumeration value) {
  return std::string(row_of(value).key);
}

/// What a person reads for a value. Throws as require_valid.
template <class Enumeration>
std::string label_of(Enumeration value) {
  return std::string(row_of(value).label);
}

/// The value of a key. Throws Error(InvalidInput), naming the choices, for any other text.
template <class Enumeration>
Enumeration from_key(std::string_view key) {
  static_assert(is_table_in_order<Enumeration>());
  for (const auto& row : enumerators<Enumeration>()) {
    if (row.key == key) return row.value;
  }
  throw Error(ErrorCode::InvalidInput,
              "The " + std::string(EnumerationTable<Enumeration>::subject) + " is \"" +
                  std::string(key) + "\", which there is not; give " + keys_of<Enumeration>() +
                  ".");
}

}  // namespace wscvt
