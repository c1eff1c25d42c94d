// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_log.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>
#include <utility>

#include "wscvt/report.h"

namespace wscvt::filter {

namespace {

constexpr std::size_t longest_line = 4000;

std::string quality_line(const RemeshResult& result, const FilterSettings& settings) {
  const std::vector<FilterParameter> parameters = filter_parameters();
  const auto parameter = std::find_if(parameters.begin(), parameters.end(),
                                      [](const auto& each) { return each.name == "Quality"; });
  const std::vector<double>& values = quality_values(result, settings.quality);
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line << "Stored      vertex quality: "
       << parameter->choices[static_cast<std::size_t>(settings.quality)];
  if (lowest != values.end()) line << ", " << *lowest << " to " << *highest;
  return line.str();
}

std::string seconds_line(double seconds) {
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line << "Seconds     " << std::fixed << std::setprecision(2) << seconds;
  return line.str();
}

std::string seed_line(const RemeshOptions& options) {
  return options.seed_start == SeedStart::Random
             ? "Seed        " + std::to_string(options.random_seed)
             : "Seed        not used by the warped lattice";
}

}  // namespace

std::vector<std::string> log_lines(const RemeshResult& result, const FilterSettings& settings,
                                   double seconds) {
  std::vector<std::string> lines{""};
  for (std::string& line : report_lines(result)) lines.push_back(std::move(line));
  lines.push_back(quality_line(result, settings));
  lines.push_back(seconds_line(seconds));
  lines.push_back(seed_line(result.options));
  for (std::string& line : lines) line.resize(std::min(line.size(), longest_line));
  return lines;
}

}  // namespace wscvt::filter
