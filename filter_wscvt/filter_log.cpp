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
             : "Seed        not used: nothing was random";
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

std::string html_line(const std::string& line) {
  const std::string no_break_space = "\u00a0";
  // HTML folds several spaces into one. A single one stays, so that sentences wrap at words, but
  // not in the indented rows of a table.
  const bool is_row = !line.empty() && line.front() == ' ';
  std::string html;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const auto is_space = [&](std::size_t at) { return at < line.size() && line[at] == ' '; };
    switch (line[k]) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case ' ':
        html += is_row || is_space(k - 1) || is_space(k + 1) ? no_break_space : " ";
        break;
      default:
        html += line[k];
    }
  }
  return html;
}

}  // namespace wscvt::filter
