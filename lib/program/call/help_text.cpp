// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/call/help_text.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace wscvt::program {

namespace {

/// Returns all paragraphs wrapped, or only the first.
std::string wrapped_paragraphs(std::string_view text, bool only_first) {
  std::string result;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += wrapped(text.substr(0, end));
    if (only_first || end == text.size()) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  std::size_t line = 0;  // characters in the last line
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (line > 0) {
      const bool fits = line + 1 + end <= width;
      result += fits ? ' ' : '\n';
      line = fits ? line + 1 : 0;
    }
    result += text.substr(0, end);
    line += end;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
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

HelpFormatter::HelpFormatter(Extent extent) : extent_(extent) {
  column_width(help_column);
  label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::All && extent_ == Extent::Brief) {
    return HelpFormatter(Extent::Full).make_help(app, std::move(name), mode);
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
  // For an option of three numbers, the type's name shows the count.
  const std::size_t place = text.find(" x ");
  return place == std::string::npos ? text : text.erase(place);
}

std::string HelpFormatter::make_option_usage(const CLI::Option* option) const {
  const std::string name = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
  return option->get_required() ? name : "[" + name + "]";
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped_paragraphs(option->get_description(), extent_ == Extent::Brief);
}

}  // namespace wscvt::program
