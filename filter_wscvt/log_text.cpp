// SPDX-License-Identifier: GPL-3.0-or-later
#include "log_text.h"

#include <QApplication>
#include <QWidget>
#include <algorithm>
#include <iomanip>
#include <locale>
#include <map>
#include <regex>
#include <sstream>
#include <string_view>

#include "filters.h"
#include "wscvt/remesh/error_target.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::filter {

namespace {

/// Breaks a text at spaces into lines of limited length. Lines after the first are indented by two
/// columns. A longer word stays whole.
std::vector<std::string> broken(const std::string& text, std::size_t width) {
  const std::size_t indent = text.find_first_not_of(' ');
  if (text.size() <= width || indent == std::string::npos) return {text};
  const std::string more(indent + 2, ' ');
  std::vector<std::string> lines;
  std::string rest = text;
  while (rest.size() > width) {
    const std::size_t begin = rest.find_first_not_of(' ');
    std::size_t space = rest.rfind(' ', width);
    if (space == std::string::npos || space < begin) space = rest.find(' ', begin);
    if (space == std::string::npos) break;
    lines.push_back(rest.substr(0, space));
    rest.replace(0, space + 1, more);
  }
  lines.push_back(rest);
  return lines;
}

}  // namespace

std::string seconds_line(double seconds) {
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line << "Time, s     " << std::fixed << std::setprecision(2) << seconds;
  return line.str();
}

std::vector<std::string> log_table(const std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t narrowest_label = 16;
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::size_t cells_width = 0;
  for (std::size_t c = 1; c < widths.size(); ++c) cells_width += 2 + widths[c];
  const bool beside = cells_width + narrowest_label <= log_width;
  if (beside) widths[0] = std::min(widths[0], log_width - cells_width);

  std::vector<std::string> lines;
  for (const auto& row : rows) {
    for (std::string& line : broken(row.front(), beside ? widths[0] : log_width)) {
      lines.push_back(std::move(line));
    }
    for (std::size_t c = 1; c < row.size(); ++c) {
      if (!beside) {
        for (std::string& line : broken("    " + row[c], log_width)) {
          lines.push_back(std::move(line));
        }
        continue;
      }
      if (c == 1) lines.back().resize(std::max(lines.back().size(), widths[0]), ' ');
      lines.back() += std::string(2 + widths[c] - row[c].size(), ' ') + row[c];
    }
    lines.back().erase(lines.back().find_last_not_of(' ') + 1);
  }
  return lines;
}

std::vector<LogLine> as_log(const std::vector<std::string>& warnings,
                            const std::vector<std::string>& lines, const LogLine& verdict) {
  constexpr std::size_t longest_line = 4000;
  std::vector<LogLine> log = {{""}};
  for (const std::string& line : lines) log.push_back({line.substr(0, longest_line)});
  for (const std::string& warning : warnings) {
    log.push_back({("Warning: " + warning).substr(0, longest_line), true});
  }
  if (!verdict.text.empty()) log.push_back({verdict.text.substr(0, longest_line), verdict.warning});
  return log;
}

std::string html_line(const std::string& line) {
  const std::string no_break_space = "\u00a0";
  // HTML merges spaces. Single spaces stay, so that sentences wrap at words, but not in the
  // indented rows of a table.
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
  if (!host_has_window()) return line.text;
  const std::string html = html_line(line.text);
  return line.warning ? "<font color=\"red\">" + html + "</font>" : html;
}

std::string shown_sentence(const std::string& sentence) {
  if (!host_has_window()) return sentence;
  return QString::fromStdString(sentence).toHtmlEscaped().toStdString();
}

namespace {

/// The parameters of all filters.
std::map<std::string, FilterParameter> parameters_by_name() {
  std::map<std::string, FilterParameter> parameters;
  for (const Filter& filter : all_filters()) {
    for (const FilterParameter& parameter : filter.parameters) {
      parameters[parameter.name] = parameter;
    }
  }
  return parameters;
}

/// The parameters that are options of the program, by the option's key.
const std::map<std::string_view, const char*>& names_by_option() {
  static const std::map<std::string_view, const char*> names = {
      {"alpha", "CurvatureAlpha"},
      {"degree", "HarmonicDegree"},
      {"edge-ratio", "EdgeRatio"},
      {"error-measure", "TargetMeasure"},
      {"max-error", "ErrorTarget"},
      {"max-overhang", "FoldLimit"},
      {"max-repaired-area", "MendLimit"},
      {"method", "Method"},
      {"nodes", "NodeCount"},
      {"placement", "Placement"},
      {"points", "Points"},
      {"roughness-cutoff", "RoughnessCutoff"},
      {"roundness-ball", "RoundnessBall"},
      {"weighting", "Weighting"},
  };
  return names;
}

/// Returns the value of an option as the dialog shows it, if it is one of the enumeration's. The
/// dialog has other words in brackets, because its choices are those of both methods.
template <class Enumeration>
void show_value(const NamedOption& option, const FilterParameter& parameter, std::string& shown) {
  if (EnumerationTable<Enumeration>::key != option.key) return;
  for (const auto& row : enumerators<Enumeration>()) {
    if (row.key != option.value) continue;
    for (const std::string& choice : parameter.choices) {
      if (short_label(choice) == short_label(row.label)) shown = choice;
    }
  }
}

/// Returns an option as the window shows it: "\"Method: On the scan\"".
std::string shown_option(const NamedOption& option,
                         const std::map<std::string, FilterParameter>& parameters) {
  const auto name = names_by_option().find(option.key);
  if (name == names_by_option().end()) return "wscvt " + Sentence(option).text();
  const FilterParameter& parameter = parameters.at(name->second);
  std::string value = option.value == "true" ? "" : option.value;
  show_value<Method>(option, parameter, value);
  show_value<ScanPlacement>(option, parameter, value);
  show_value<PublishedPlacement>(option, parameter, value);
  return "\"" + parameter.label + (value.empty() ? "" : ": " + value) + "\"";
}

/// Returns the text with the label before a script parameter: "Parameter \"Report file\"
/// (ReportFile)".
std::string with_label(const std::string& text, const std::string& name, const std::string& label) {
  const std::string shown = "\"" + label + "\" (" + name + ")";
  const std::regex alone("\\bParameter " + name + "\\b");
  const std::regex among_others("(\\bParameters .*)\\b" + name + "\\b(?!\\))");
  return std::regex_replace(std::regex_replace(text, alone, "Parameter " + shown), among_others,
                            "$1" + shown);
}

}  // namespace

std::string shown_words(const Sentence& sentence) {
  const std::map<std::string, FilterParameter> parameters = parameters_by_name();
  std::string text =
      sentence.in([&](const NamedOption& option) { return shown_option(option, parameters); });
  for (const auto& [name, parameter] : parameters) text = with_label(text, name, parameter.label);
  return text;
}

}  // namespace wscvt::filter
