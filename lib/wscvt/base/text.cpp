// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/text.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

namespace wscvt {

namespace {

bool is_digit(char byte) { return byte >= '0' && byte <= '9'; }

/// Returns the number of digits from `at`.
std::size_t digits_from(const std::string& text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - at;
}

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

/// Whether a spreadsheet would read a text, or what stands behind ' in it, as a formula.
bool begins_formula(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  constexpr std::string_view firsts = "=+-@\t\r";
  return text.size() > 1 && firsts.find(text.front()) != std::string_view::npos;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  // Not std::tolower, because it depends on the locale.
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return lower;
}

std::string listed(const std::vector<std::string>& words, std::size_t most) {
  std::string text;
  for (std::size_t k = 0; k < std::min(words.size(), most); ++k) {
    text += (k == 0 ? "" : ", ") + words[k];
  }
  return words.size() > most ? text + ", ..." : text;
}

std::string enumerated(const std::vector<std::string>& words, const std::string& before_last) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (k > 0) text += k + 1 < words.size() ? ", " : before_last;
    text += words[k];
  }
  return text;
}

std::string ending_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

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
    result += c == '&'   ? "&amp;"
              : c == '<' ? "&lt;"
              : c == '>' ? "&gt;"
              : c == '"' ? "&quot;"
                         : std::string(1, c);
  }
  return result;
}

std::string csv_field(std::string_view text) {
  std::string field = readable(text, "\t\n\r");
  if (begins_formula(field) && !is_number(field)) field.insert(field.begin(), '\'');
  return field;
}

std::string_view text_of_field(std::string_view field) {
  return field.substr(!field.empty() && field.front() == '\'' && begins_formula(field) ? 1 : 0);
}

}  // namespace wscvt
