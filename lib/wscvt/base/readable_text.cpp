// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/readable_text.h"

#include <charconv>
#include <cstddef>
#include <system_error>

namespace wscvt {

namespace {

/// Returns the number of bytes of a text's first character; 0 if it is not UTF-8.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xc0U) != 0x80) return 0;
  }
  // Overlong forms, halves of UTF-16 pairs, and numbers beyond the last character.
  const bool is_none = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) > 0x9f) ||
                       (first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) > 0x8f);
  return is_none ? 0 : length;
}

/// Whether a non-empty UTF-8 text begins with a control character: of ASCII, or U+0080 to U+009F.
bool is_control(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return first < ' ' || first == 0x7f;
  return first == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0;
}

bool is_number(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end;
}

}  // namespace

std::string readable(std::string_view text, std::string_view kept) {
  constexpr const char* digits = "0123456789ABCDEF";
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const bool is_kept = kept.find(text.front()) != std::string_view::npos;
    std::size_t length = utf8_length(text);
    if (length > 0 && (is_kept || !is_control(text))) {
      result += text.substr(0, length);
    } else {
      length = 1;
      const auto byte = static_cast<unsigned char>(text.front());
      result += {'\\', 'x', digits[byte >> 4], digits[byte & 0xf]};
    }
    text.remove_prefix(length);
  }
  return result;
}

std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : readable(text, "\t\n")) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string csv_field(std::string_view text) {
  std::string field = readable(text, "\t\n\r");
  constexpr std::string_view begins_formula = "=+-@\t\r";
  if (field.size() > 1 && begins_formula.find(field.front()) != std::string_view::npos &&
      !is_number(field)) {
    field.insert(field.begin(), '\'');
  }
  return field;
}

}  // namespace wscvt
