// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/text_format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>
#include <utility>

#include "wscvt/base/text.h"

namespace wscvt {

std::string format_number(double value, int significant) {
  if (std::isnan(value)) return "-";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(significant) << value;
  return text.str();
}

std::string format_coordinate(double value, double size) {
  constexpr int most = 15;
  int digits = 6;
  for (double reach = 10.0 * std::abs(size);
       digits < most && std::abs(value) > reach && reach > 0.0; reach *= 10.0) {
    ++digits;
  }
  return format_number(value, digits);
}

std::string format_typed(double value) {
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-6 && size < 1e15);
  std::array<char, 32> text{};
  const auto end =
      plain ? std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed)
            : std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string format_percent(double fraction) { return format_number(100.0 * fraction, 3) + " %"; }

std::string format_above(double limit, double value) {
  int digits = 3;
  while (digits < 17 && format_number(value, digits) == format_number(limit, digits)) ++digits;
  return format_number(value, digits);
}

std::string format_error(double percent) {
  if (!std::isfinite(percent)) return "-";
  // Sums over a million triangles have relative errors of some 1e-12, 1e-10 %.
  if (std::abs(percent) < 1e-9) return "exact";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::showpos;
  if (std::abs(percent) < 1e-3) {
    text << std::scientific << std::setprecision(1);
  } else {
    text << std::fixed << std::setprecision(3);
  }
  text << percent;
  return text.str();
}

std::string error_text(double percent) {
  const std::string error = format_error(percent);
  return error == "exact" || error == "-" ? error : error + " %";
}

std::string format_exact(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string format_count(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

std::vector<std::string> aligned_lines(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::vector<std::string> lines;
  lines.reserve(rows.size());
  for (const auto& row : rows) {
    std::string text;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(widths[c] - row[c].size(), ' ');
      text += c == 0 ? row[c] + padding : "  " + padding + row[c];
    }
    text.erase(text.find_last_not_of(' ') + 1);
    lines.push_back(std::move(text));
  }
  return lines;
}

std::string csv_record(const std::vector<std::string>& fields) {
  std::string record;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) record += ',';
    const std::string field = csv_field(fields[i]);
    if (field.find_first_of(",\"\r\n") == std::string::npos) {
      record += field;
      continue;
    }
    record += '"';
    for (const char c : field) {
      if (c == '"') record += '"';
      record += c;
    }
    record += '"';
  }
  return record + "\r\n";
}

}  // namespace wscvt
