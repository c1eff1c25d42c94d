// SPDX-License-Identifier: GPL-3.0-or-later
#include "log_text.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>

namespace wscvt::filter {

std::string seconds_line(double seconds) {
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line << "Seconds     " << std::fixed << std::setprecision(2) << seconds;
  return line.str();
}

void cut_lines(std::vector<std::string>& lines) {
  constexpr std::size_t longest_line = 4000;
  for (std::string& line : lines) line.resize(std::min(line.size(), longest_line));
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
