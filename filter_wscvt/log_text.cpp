// SPDX-License-Identifier: GPL-3.0-or-later
#include "log_text.h"

#include <QApplication>
#include <QWidget>
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

std::vector<LogLine> as_log(const std::vector<std::string>& warnings,
                            const std::vector<std::string>& lines) {
  constexpr std::size_t longest_line = 4000;
  std::vector<LogLine> log = {{""}};
  for (const std::string& line : lines) log.push_back({line.substr(0, longest_line)});
  // Last, because MeshLab scrolls its log to the end.
  for (const std::string& warning : warnings) {
    log.push_back({warning.substr(0, longest_line), true});
  }
  return log;
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

bool host_has_window() {
  const QWidgetList widgets = QApplication::topLevelWidgets();
  return std::any_of(widgets.begin(), widgets.end(),
                     [](const QWidget* widget) { return widget->inherits("QMainWindow"); });
}

std::string shown_line(const LogLine& line) {
  std::string text = line.warning ? "Warning: " + line.text : line.text;
  if (!host_has_window()) return text;
  return line.warning ? "<font color=\"red\">" + html_line(text) + "</font>" : html_line(text);
}

std::string shown_sentence(const std::string& sentence) {
  if (!host_has_window()) return sentence;
  return QString::fromStdString(sentence).toHtmlEscaped().toStdString();
}

}  // namespace wscvt::filter
