// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/given_sizes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "toolbox/sample/csv_reader.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/table_heading.h"

namespace wscvt {

namespace {

/// Refuses a heading whose columns are not what is read.
void check_heading(const std::vector<std::string>& fields, const std::string& path) {
  const std::string first = lower_case(fields[0]);
  const std::string second = lower_case(fields.size() < 2 ? "" : fields[1]);
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
  } else if (nanometres(known_unit(second).value_or(read_heading(second).unit)) > 0.0 &&
             !has(second, {"%"})) {
    what = "has a length in the second column. Write the percentage finer by mass there";
  }
  if (!what.empty()) refuse("The heading of \"" + path + "\" " + what + ".");
}

/// Returns the grains per mass at a diameter, up to a factor.
double per_mass(double diameter) { return 1.0 / (diameter * diameter * diameter); }

}  // namespace

GivenSizes::GivenSizes(std::vector<double> diameters, std::vector<double> percentages)
    : diameters_(std::move(diameters)), percentages_(std::move(percentages)) {
  const std::size_t count = diameters_.size();
  if (count < 2 || percentages_.size() != count) {
    refuse("A size curve has " + std::to_string(count) + " diameters and " +
           std::to_string(percentages_.size()) + " percentages. Give two or more of each.");
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (!(diameters_[k] > (k == 0 ? 0.0 : diameters_[k - 1])) ||
        !(percentages_[k] >= (k == 0 ? 0.0 : percentages_[k - 1])) || percentages_[k] > 100.0) {
      refuse("Point " + std::to_string(k + 1) + " of the size curve is " +
             format_typed(diameters_[k]) + ", " + format_typed(percentages_[k]) +
             " %. Give diameters above 0 and percentages from 0 to 100 that both ascend.");
    }
  }
  if (percentages_.front() != 0.0 || percentages_.back() != 100.0) {
    refuse("The size curve runs from " + format_typed(percentages_.front()) + " % to " +
           format_typed(percentages_.back()) +
           " %. Add its ends, the smallest diameter at 0 % and the largest at 100 %.");
  }
  numbers_.push_back(0.0);
  for (std::size_t k = 1; k < count; ++k) {
    const double width = 3.0 * portable::log(diameters_[k] / diameters_[k - 1]);
    const double mean = (per_mass(diameters_[k - 1]) - per_mass(diameters_[k])) / width;
    numbers_.push_back(numbers_.back() + (percentages_[k] - percentages_[k - 1]) * mean);
  }
  for (double& number : numbers_) number /= numbers_.back();
}

std::string GivenSizes::heading() {
  return csv_record({"equivalent_diameter [length]", "finer_by_mass [%]"});
}

std::string GivenSizes::table(double scale) const {
  std::string text = heading();
  for (std::size_t k = 0; k < diameters_.size(); ++k) {
    text += csv_record({format_exact(scale * diameters_[k]), format_exact(percentages_[k])});
  }
  return text;
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
  InputFile file(path);
  std::vector<double> diameters;
  std::vector<double> percentages;
  CsvReader reader(file, Separator::OfEachRecord);
  const auto refuse_line = [&] {
    refuse("Line " + std::to_string(reader.line()) + " of \"" + path +
           "\" is not a diameter, a comma and the percentage finer by mass, as two numbers. Write "
           "a unit into the heading only, and all diameters in it.");
  };
  std::vector<std::string> fields;
  while (reader.next(fields) || reader.last(fields)) {
    const std::string& text = reader.text();
    const std::size_t first = text.find_first_not_of(" \t\r\n\"+-.,;");
    if (first == std::string::npos) continue;
    const auto number = [&](std::size_t k) -> std::optional<double> {
      const auto read = number_in_field(k < fields.size() ? fields[k] : "", reader.decimal());
      if (read && std::isfinite(*read)) return read;
      return {};
    };
    const auto diameter = number(0);
    const auto percentage = number(1);
    const bool begins_with_number = text[first] >= '0' && text[first] <= '9';
    if (diameter && percentage && fields.size() == 2) {
      diameters.push_back(*diameter);
      percentages.push_back(*percentage);
    } else if (diameters.empty() && !begins_with_number && !percentage) {
      check_heading(fields, path);
    } else {
      refuse_line();
    }
  }
  if (reader.is_cut()) refuse_line();
  return {std::move(diameters), std::move(percentages)};
}

}  // namespace wscvt
