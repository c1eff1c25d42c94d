// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/given_sizes.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

/// `decimal`: the decimal mark besides the point.
std::optional<double> number_of(std::string text, char decimal) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.pop_back();
  }
  text.erase(0, text.find_first_not_of(" \t\""));
  if (!text.empty() && text.back() == '"') text.pop_back();
  std::replace(text.begin(), text.end(), decimal, '.');
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return {};
  return value;
}

/// A line in two fields. Only commas separate where there is no semicolon and no tab.
struct Fields {
  std::string first;
  std::string second;
  char decimal = '.';
};

Fields fields_of(const std::string& text) {
  std::size_t cut = text.find_first_of(";\t");
  const char decimal = cut == std::string::npos ? '.' : ',';
  if (cut == std::string::npos) cut = text.find(',');
  if (cut == std::string::npos) return {text, "", decimal};
  return {text.substr(0, cut), text.substr(cut + 1), decimal};
}

/// Refuses a heading whose columns are not what is read.
void check_heading(const Fields& heading, const std::string& path) {
  const std::string first = lower_case(heading.first);
  const std::string second = lower_case(heading.second);
  const auto has = [](const std::string& text, const std::vector<std::string>& words) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return text.find(word) != std::string::npos;
    });
  };
  std::string what;
  if (has(first, {"%", "finer", "passing", "percent"}) && !has(second, {"%", "finer", "passing"})) {
    what = "has the percentages first. Write the diameters into the first column";
  } else if (has(second, {"retained", "coarser", "oversize"})) {
    what = "has the percentage retained or coarser. Write the percentage finer, which rises to 100";
  } else if (has(first, {"phi", "\xcf\x86"})) {
    what = "has sizes on the phi scale. Write diameters: 2 to the power of -phi, in mm";
  } else if (has(second, {"mm", "um", "\xc2\xb5m"}) && !has(second, {"%"})) {
    what = "has a length in the second column. Write the percentage finer by mass there";
  }
  if (!what.empty()) refuse("The heading of \"" + path + "\" " + what + ".");
}

/// Returns the grains per mass at a diameter, up to a factor.
double per_mass(double diameter) { return 1.0 / (diameter * diameter * diameter); }

}  // namespace

GivenSizes::GivenSizes(std::vector<double> diameters, std::vector<double> percentages)
    : diameters_(std::move(diameters)) {
  const std::size_t count = diameters_.size();
  if (count < 2 || percentages.size() != count) {
    refuse("A size curve has " + std::to_string(count) + " diameters and " +
           std::to_string(percentages.size()) + " percentages. Give two or more of each.");
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (!(diameters_[k] > (k == 0 ? 0.0 : diameters_[k - 1])) ||
        !(percentages[k] >= (k == 0 ? 0.0 : percentages[k - 1])) || percentages[k] > 100.0) {
      refuse("Point " + std::to_string(k + 1) + " of the size curve is " +
             format_typed(diameters_[k]) + ", " + format_typed(percentages[k]) +
             " %. Give diameters above 0 and percentages from 0 to 100 that both ascend.");
    }
  }
  if (percentages.front() != 0.0 || percentages.back() != 100.0) {
    refuse("The size curve runs from " + format_typed(percentages.front()) + " % to " +
           format_typed(percentages.back()) +
           " %. Add its ends, the smallest diameter at 0 % and the largest at 100 %.");
  }
  numbers_.push_back(0.0);
  for (std::size_t k = 1; k < count; ++k) {
    const double width = 3.0 * portable::log(diameters_[k] / diameters_[k - 1]);
    const double mean = (per_mass(diameters_[k - 1]) - per_mass(diameters_[k])) / width;
    numbers_.push_back(numbers_.back() + (percentages[k] - percentages[k - 1]) * mean);
  }
  for (double& number : numbers_) number /= numbers_.back();
}

double GivenSizes::diameter(double fraction) const {
  const auto above = std::upper_bound(numbers_.begin() + 1, numbers_.end() - 1, fraction);
  const auto k = static_cast<std::size_t>(above - numbers_.begin());
  const double width = numbers_[k] - numbers_[k - 1];
  const double part =
      width > 0.0 ? std::clamp((fraction - numbers_[k - 1]) / width, 0.0, 1.0) : 0.0;
  const double first = per_mass(diameters_[k - 1]);
  return 1.0 / portable::cbrt(first + part * (per_mass(diameters_[k]) - first));
}

GivenSizes read_given_sizes(const std::string& path) {
  errno = 0;
  refuse_device(path);
  std::ifstream file(path);
  if (!file) refuse_to_open(path, errno);
  std::vector<double> diameters;
  std::vector<double> percentages;
  std::size_t line = 0;
  bool may_be_heading = true;
  for (std::string text; std::getline(file, text);) {
    ++line;
    if (line == 1 && text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
    const bool is_blank = text.find_first_not_of(" \t\r") == std::string::npos;
    if (is_blank || (may_be_heading && names_separator(text))) continue;
    const Fields fields = fields_of(text);
    const auto diameter = number_of(fields.first, fields.decimal);
    const auto percentage = number_of(fields.second, fields.decimal);
    const bool has_digit = text.find_first_of("0123456789") == text.find_first_not_of(" \t\"+-.,;");
    if (diameter && percentage) {
      diameters.push_back(*diameter);
      percentages.push_back(*percentage);
    } else if (may_be_heading && !has_digit) {
      check_heading(fields, path);
    } else if (!diameters.empty() || has_digit || trimmed(fields.second) != "%") {  // or units
      refuse(
          "Line " + std::to_string(line) + " of \"" + path +
          "\" is not a diameter, a comma and the percentage finer by mass, as two numbers. Write "
          "a unit into the heading only, and all diameters in it.");
    }
    may_be_heading = false;
  }
  if (file.bad()) refuse_to_read(path);
  return {std::move(diameters), std::move(percentages)};
}

}  // namespace wscvt
