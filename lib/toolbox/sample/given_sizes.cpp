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
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

std::optional<double> number_of(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.pop_back();
  }
  text.erase(0, text.find_first_not_of(" \t\""));
  if (!text.empty() && text.back() == '"') text.pop_back();
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return {};
  return value;
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
  for (std::string text; std::getline(file, text);) {
    ++line;
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::size_t cut = text.find_first_of(",;\t");
    const auto diameter = number_of(text.substr(0, cut));
    const auto percentage =
        cut == std::string::npos ? std::nullopt : number_of(text.substr(cut + 1));
    if (diameter && percentage) {
      diameters.push_back(*diameter);
      percentages.push_back(*percentage);
    } else if (line > 1) {
      refuse("Line " + std::to_string(line) + " of \"" + path +
             "\" is not a diameter, a comma and the percentage finer by mass.");
    }
  }
  if (file.bad()) refuse_to_read(path);
  return {std::move(diameters), std::move(percentages)};
}

}  // namespace wscvt
