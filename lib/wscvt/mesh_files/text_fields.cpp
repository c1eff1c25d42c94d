// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/text_fields.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace wscvt {

namespace {

template <class Number>
std::optional<Number> parse(std::string_view field) {
  // std::from_chars accepts no plus sign. "+-1" must not become valid.
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  Number value{};
  const char* const end = field.data() + field.size();
  const auto [parsed_to, error] = std::from_chars(field.data(), end, value);
  if (field.empty() || error != std::errc() || parsed_to != end) return {};
  return value;
}

}  // namespace

std::optional<double> number_in(std::string_view field) { return parse<double>(field); }

std::optional<std::int64_t> whole_number_in(std::string_view field) {
  return parse<std::int64_t>(field);
}

std::string_view trimmed(std::string_view text) {
  constexpr const char* white_space = " \t\r\n\v\f";
  const std::size_t begin = text.find_first_not_of(white_space);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(white_space) - begin + 1);
}

char separator_in(std::string_view line, std::string_view separators) {
  for (const char separator : separators) {
    bool is_quoted = false;
    for (const char c : line) {
      if (c == '"') is_quoted = !is_quoted;
      if (c == separator && !is_quoted) return c;
    }
  }
  return '\0';
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  const char separator = separator_in(line, ";,");
  bool is_quoted = false;
  std::size_t begin = 0;
  for (std::size_t k = 0; k <= line.size(); ++k) {
    const char c = k < line.size() ? line[k] : '\n';
    if (c == '"') is_quoted = !is_quoted;
    const bool ends = separator == '\0' ? is_blank(c) : c == separator;
    if (k < line.size() && (is_quoted || !ends)) continue;
    const std::string_view field = line.substr(begin, k - begin);
    const std::size_t first = std::min(field.find_first_not_of(" \t\r\""), field.size());
    const std::size_t last = field.find_last_not_of(" \t\r\"") + 1;
    if (separator != '\0' || first < last) {
      fields.push_back(field.substr(first, std::max(first, last) - first));
    }
    begin = k + 1;
  }
  if (fields.empty()) fields.emplace_back();
}

std::optional<double> number_in_row(std::string_view field, std::string_view line) {
  std::string text(field);
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos && separator_in(line, ";") != '\0') text[comma] = '.';
  return number_in(text);
}

bool names_separator(std::string_view line) { return lower_case(line.substr(0, 4)) == "sep="; }

std::string shown(std::string_view field) {
  constexpr std::size_t longest = 40;
  std::string text;
  for (const char c : field.substr(0, longest)) {
    text += c >= ' ' && c <= '~' ? c : '?';
  }
  return text + (field.size() > longest ? "..." : "");
}

std::string in_quotes(std::string_view field) { return "\"" + shown(field) + "\""; }

}  // namespace wscvt
