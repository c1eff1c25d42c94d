// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/call/help_text.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "program/terminal/terminal.h"

namespace wscvt::program {

namespace {

/// Returns all lines of a text broken at `width`, or only those of the first. `indent` as wrapped.
std::string wrapped_lines(std::string_view text, std::size_t width, std::size_t indent,
                          bool only_first = false) {
  std::string result;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += wrapped(text.substr(0, end), width, indent);
    if (only_first || end == text.size()) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::size_t help_width() {
  constexpr std::size_t narrowest = 60;
  constexpr std::size_t widest = 120;
  const std::size_t columns = terminal_columns(Stream::Output);
  return columns == 0 ? 100 : std::clamp(columns, narrowest, widest);
}

std::vector<HelpParagraph> help_paragraphs(const CLI::Option& option) {
  std::vector<HelpParagraph> paragraphs;
  std::string_view rest = option.get_description();
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    // Format of help_of_choices.
    const std::size_t colon = line.find(": ");
    const bool is_value = !paragraphs.empty() && colon != std::string_view::npos &&
                          line.substr(0, colon).find_first_not_of(
                              "abcdefghijklmnopqrstuvwxyz0123456789-") == std::string_view::npos;
    if (is_value) {
      paragraphs.push_back(
          {std::string(line.substr(0, colon)), std::string(line.substr(colon + 2))});
    } else {
      paragraphs.push_back({"", std::string(line)});
    }
  }
  return paragraphs;
}

std::vector<std::string> listed_values(const CLI::Option& option) {
  std::vector<std::string> values;
  for (HelpParagraph& paragraph : help_paragraphs(option)) {
    const bool is_new = std::find(values.begin(), values.end(), paragraph.value) == values.end();
    if (!paragraph.value.empty() && is_new) values.push_back(std::move(paragraph.value));
  }
  return values;
}

HelpFormatter::HelpFormatter(Extent extent, std::size_t width) : extent_(extent), width_(width) {
  column_width(help_column);
  label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::All && extent_ == Extent::Brief) {
    return HelpFormatter(Extent::Full, width_).make_help(app, std::move(name), mode);
  }
  std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
  // Hidden groups leave their empty lines.
  for (std::size_t place = text.find("\n\n\n"); place != std::string::npos;
       place = text.find("\n\n\n")) {
    text.erase(place, 1);
  }
  return text;
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  if (extent_ == Extent::Brief && group == finer_settings) return "";
  return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped_lines(CLI::Formatter::make_description(app), width_, 0);
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  return wrapped_lines(CLI::Formatter::make_usage(app, std::move(name)), width_, 2);
}

std::string HelpFormatter::make_subcommand(const CLI::App* app) const {
  std::ostringstream line;
  CLI::detail::format_help(line, app->get_display_name(true),
                           wrapped(app->get_description(), width_ - help_column), help_column);
  return line.str();
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  std::string text;
  std::istringstream lines(CLI::Formatter::make_footer(app));
  for (std::string line; std::getline(lines, line);) {
    // A call takes a backslash where it is broken, so that it runs when it is copied.
    const bool is_call = line.rfind("  ", 0) == 0;
    std::string broken = is_call ? wrapped(line, width_ - 2, 6) : wrapped(line, width_);
    for (std::size_t at = broken.find('\n'); is_call && at != std::string::npos;
         at = broken.find('\n', at + 3)) {
      broken.insert(at, " \\");
    }
    text += broken + "\n";
  }
  return text;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  if (is_positional || !option->get_positional()) {
    return CLI::Formatter::make_option(option, is_positional);
  }
  std::ostringstream line;
  CLI::detail::format_help(line, make_option_name(option, false) + " " + option->get_type_name(),
                           "Same as " + option->get_name(true), help_column);
  return line.str();
}

std::string HelpFormatter::make_option_name(const CLI::Option* option, bool is_positional) const {
  std::string name = CLI::Formatter::make_option_name(option, is_positional);
  const std::string of_parser = "{false}";
  const std::size_t place = name.find(of_parser);
  return place == std::string::npos ? name : name.erase(place, of_parser.size());
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  std::string text = CLI::Formatter::make_option_opts(option);
  // The description says what an option belongs to.
  text.erase(std::min(text.find(" Needs:"), text.size()));
  // For an option of three numbers, the type's name shows the count.
  const std::size_t place = text.find(" x ");
  return place == std::string::npos ? text : text.erase(place);
}

std::string HelpFormatter::make_option_usage(const CLI::Option* option) const {
  const std::string name = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
  return option->get_required() ? name : "[" + name + "]";
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped_lines(option->get_description(), width_ - help_column, 0,
                       extent_ == Extent::Brief);
}

}  // namespace wscvt::program
