// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/table_heading.h"

#include <algorithm>

#include "wscvt/base/text.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct LengthUnit {
  double nanometres;                    ///< 0: no length
  std::vector<std::string_view> names;  ///< in lower case, ours first
};

const std::vector<LengthUnit>& length_units() {
  static const std::vector<LengthUnit> all = {
      {1e3,
       {"um", "\xc2\xb5m", "\xce\xbcm", "\\u00b5m", "micron", "microns", "micrometer",
        "micrometers", "micrometre", "micrometres"}},
      {1.0, {"nm", "nanometer", "nanometers", "nanometre", "nanometres"}},
      {1e6, {"mm", "millimeter", "millimeters", "millimetre", "millimetres"}},
      {1e7, {"cm", "centimeter", "centimeters", "centimetre", "centimetres"}},
      {1e9, {"m", "meter", "meters", "metre", "metres"}},
      {25.4e6, {"inch", "in", "inches"}},
      {0.0, {"voxel", "voxels", "pixel", "pixels", "px"}}};
  return all;
}

/// Returns a text that is no UTF-8 as Latin-1.
std::string as_utf8(std::string_view text) {
  std::string result;
  if (readable(text, "\t\n\r") == text) return result.append(text);
  for (const char byte : text) {
    const auto code = static_cast<unsigned char>(byte);
    if (code < 0xa0) {
      result += byte;
    } else {
      result += static_cast<char>(0xc0U | code >> 6U);
      result += static_cast<char>(0x80U | (code & 0x3fU));
    }
  }
  return result;
}

bool is_bracketed(std::string_view text) {
  return text.size() > 1 && ((text.front() == '[' && text.back() == ']') ||
                             (text.front() == '(' && text.back() == ')'));
}

/// Returns the text between brackets, or the text if it has none.
std::string_view without_brackets(std::string_view text) {
  return is_bracketed(text) ? trimmed(text.substr(1, text.size() - 2)) : text;
}

}  // namespace

TableHeading read_heading(std::string_view text) {
  constexpr const char* between = ",_/ ";  // a name and its unit
  const std::string utf8 = as_utf8(trimmed(text));
  const std::string_view whole = utf8;
  const char last = whole.empty() ? ' ' : whole.back();
  const std::size_t end = last == ']'   ? whole.rfind('[')
                          : last == ')' ? whole.rfind('(')
                                        : whole.find_last_of(between);
  if (end == std::string_view::npos || end == 0) return {utf8, "", utf8};
  const std::string_view name = whole.substr(0, whole.find_last_not_of(between, end - 1) + 1);
  const bool is_plain = last != ']' && last != ')';
  const std::string_view rest = trimmed(whole.substr(is_plain ? end + 1 : end));
  const auto unit = known_unit(rest);
  if (name.empty() || (is_plain && !unit)) return {utf8, "", utf8};
  return {std::string(name), unit.value_or(std::string(without_brackets(rest))), utf8};
}

std::vector<TableHeading> read_headings(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of("# \t\xEF\xBB\xBF"), line.size()));
  std::vector<std::string_view> fields;
  split_fields(line, fields);
  std::vector<TableHeading> headings;
  for (const std::string_view field : fields) {
    if (is_bracketed(field) && !headings.empty() && headings.back().unit.empty()) {
      headings.back().unit = known_unit(field).value_or(std::string(without_brackets(field)));
    } else {
      headings.push_back(read_heading(field));
    }
  }
  return headings;
}

std::optional<std::string> known_unit(std::string_view text) {
  std::string name = lower_case(as_utf8(without_brackets(trimmed(text))));
  if (name == "-") return "";
  if (name.empty()) return {};
  std::string power;
  const char last = name.back();  // of ² and ³ in UTF-8, too
  if (name.size() > 1 && std::string_view("23\xb2\xb3").find(last) != std::string_view::npos) {
    power = {'^', static_cast<char>('0' + (last & 0xf))};
    name.resize(name.find_last_not_of("^\xc2", name.size() - 2) + 1);
  }
  for (const LengthUnit& unit : length_units()) {
    const auto& names = unit.names;
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    return std::string(names.front()) + power;
  }
  return {};
}

double nanometres(std::string_view unit) {
  for (const LengthUnit& one : length_units()) {
    if (one.names.front() == unit) return one.nanometres;
  }
  return 0.0;
}

CommonUnit common_unit(const std::vector<std::string>& units) {
  CommonUnit common;
  for (const std::string& unit : units) {
    if (common.unit.empty()) common.unit = unit;
    if (unit.empty() || unit == common.unit) continue;
    common.fault = "has columns in " + readable(common.unit, "") + " and in " + readable(unit, "") +
                   ", which are two units. Convert them to one.";
    break;
  }
  return common;
}

}  // namespace wscvt
