// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/base/option.h"

namespace wscvt::program {

/// Width of the column of the options' names in the help.
inline constexpr int help_column = 30;

/// Heading of the options that only --help-all shows.
inline constexpr const char* finer_settings = "Advanced options";

/// Returns the width of the help: the terminal's, between 60 and 120 characters, or 100 if the
/// standard output is no terminal.
std::size_t help_width();

/// A paragraph of an option's description.
struct HelpParagraph {
  std::string value;  ///< value of the option that the text explains; or empty
  std::string text;
};
std::vector<HelpParagraph> help_paragraphs(const CLI::Option& option);

/// Returns the values listed in an option's description, each once; empty for an option without
/// named values.
std::vector<std::string> listed_values(const CLI::Option& option);

/// Formats the help. --help-all shows everything. --help fits on a screen: it leaves out the
/// advanced options and shows only the first paragraph of each option.
class HelpFormatter : public CLI::Formatter {
 public:
  enum class Extent { Brief, Full };
  explicit HelpFormatter(Extent extent = Extent::Brief, std::size_t width = 100);

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_subcommand(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_usage(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;

 private:
  Extent extent_;
  std::size_t width_;
};

// Descriptions of options, with one or more paragraphs. HelpFormatter breaks their lines.

/// "Random seed, 0 or more: of the random start. Default: 1".
template <class Number>
std::string help_of(Number value, const NumberOption<Number>& option) {
  std::string text = capitalised(option.subject) + ", " + range_text(option);
  if (!option.meaning.empty()) text += ": " + std::string(option.meaning);
  return text + ". Default: " + typed_text(value);
}

inline std::string help_of(bool value, const FlagOption& option) {
  return capitalised(option.subject) + " " + std::string(option.meaning) +
         (value ? ". Default: on" : "");
}

/// Returns the subject and the choices of an enumeration, then every value with its meaning on its
/// own line.
template <class Enumeration>
std::string help_of_choices(const std::string& after_them = "") {
  std::string text = capitalised(EnumerationTable<Enumeration>::subject);
  text += ": " + keys_of<Enumeration>() + after_them;
  for (const Enumerator<Enumeration>& row : enumerators<Enumeration>()) {
    const std::string_view meaning = row.meaning.empty() ? row.label : row.meaning;
    text.append("\n").append(row.key).append(": ").append(meaning);
  }
  return text;
}

/// Returns the text of help_of_choices with the default.
template <class Enumeration>
std::string help_of(Enumeration value) {
  return help_of_choices<Enumeration>(". Default: " + key_of(value));
}

/// Returns a script with which bash completes commands, options, and named values of options.
/// Everything else completes to files.
std::string bash_completion(const CLI::App& program);

/// A manual page, in roff.
struct ManPage {
  std::string file;  ///< "wscvt-remesh.1"
  std::string text;
};

/// Returns the pages of the program and of its commands, made from their helps. They contain no
/// date, so that every build makes the same pages.
std::vector<ManPage> man_pages(const CLI::App& program);

}  // namespace wscvt::program
