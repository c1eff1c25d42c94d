// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/numbered_names.h"

#include <algorithm>
#include <cstddef>

namespace wscvt {

namespace {

bool is_digit(char byte) { return byte >= '0' && byte <= '9'; }

/// Returns the number of digits from `at`.
std::size_t digits_from(const std::string& text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - at;
}

}  // namespace

// The names are compared from their first difference on. If it lies within numbers without leading
// zeros, the number with more digits is larger. A number with leading zeros counts as the decimals
// of a fraction: so 000 < 00 < 01 < 010 < 09 < 0 < 1 < 9 < 10, as the manual of strverscmp says.
int compare_numbered(const std::string& a, const std::string& b) {
  const std::size_t shorter = std::min(a.size(), b.size());
  std::size_t at = 0;
  while (at < shorter && a[at] == b[at]) ++at;
  if (at == a.size() && at == b.size()) return 0;
  std::size_t begin = at;
  while (begin > 0 && is_digit(a[begin - 1])) --begin;
  const std::size_t digits_a = digits_from(a, at);
  const std::size_t digits_b = digits_from(b, at);
  const bool has_prefix = begin < at;
  const char first_a = begin < a.size() ? a[begin] : '\0';
  const char first_b = begin < b.size() ? b[begin] : '\0';
  if (is_digit(first_a) && is_digit(first_b) && first_a != '0' && first_b != '0') {
    if (digits_a != digits_b) return digits_a < digits_b ? -1 : 1;
  } else if (has_prefix && a.find_first_not_of('0', begin) >= at &&
             (digits_a > 0 || digits_b > 0)) {
    // Behind equal zeros, another digit makes a longer fraction, which comes first.
    if (digits_a == 0 || digits_b == 0) return digits_a > 0 ? -1 : 1;
  }
  const int byte_a = at < a.size() ? static_cast<unsigned char>(a[at]) : -1;
  const int byte_b = at < b.size() ? static_cast<unsigned char>(b[at]) : -1;
  return byte_a - byte_b;
}

}  // namespace wscvt
