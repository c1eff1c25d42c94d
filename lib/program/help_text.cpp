// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_text.h"

#include <algorithm>
#include <utility>

namespace wscvt::program {

namespace {

/// Every paragraph wrapped; with `only_first`, the first.
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

std::string wrapped(std::string_view text) {
  constexpr std::size_t width = 100 - help_column;
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

HelpFormatter::HelpFormatter(Extent extent) : extent_(extent) { column_width(help_column); }

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  if (mode == CLI::AppFormatMode::All && extent_ == Extent::Brief) {
    return HelpFormatter(Extent::Full).make_help(app, std::move(name), mode);
  }
  std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
  // Groups that are not shown leave their distances.
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

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped_paragraphs(option->get_description(), extent_ == Extent::Brief);
}

}  // namespace wscvt::program
