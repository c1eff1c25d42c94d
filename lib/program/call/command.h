// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "program/call/help_text.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text.h"

namespace wscvt::program {

/// Name of a command, and its help texts other than those of its options.
struct CommandText {
  std::string name;
  std::string purpose;                ///< one line
  std::vector<std::string> examples;  ///< calls, without "wscvt" and the name
  std::string notes = {};             ///< lines below the examples; may be empty
  bool has_finer_settings = false;    ///< only --help-all shows them
  bool some_may_fail = false;         ///< works on many grains: exit code SomeFailed
};

/// Returns the text of the exit codes at the end of every help.
std::string exit_code_text(bool some_may_fail);

/// Adds a command to the program. The caller adds its arguments.
CLI::App& add_command(CLI::App& program, const CommandText& text);

/// Adds an argument whose text `read` reads. If `read` throws wscvt::Error, the call is refused
/// with its message. `names` are as in CLI11: "-n,--nodes". If an argument is given twice, the
/// later one counts.
CLI::Option* add_typed(CLI::App& app, const std::string& names,
                       const std::function<void(std::string_view)>& read);

/// Adds the output file or folder: the last word, `name`, or -o. Parsing changes `path`, which must
/// outlive `app`.
CLI::Option* add_output(CLI::App& app, const std::string& name, std::string& path,
                        const std::string& description, const std::string& type = "FILE");

/// Adds an argument for a number. Parsing changes `value`. `value` and `option` must outlive `app`.
template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& names, Number& value,
                        const NumberOption<Number>& option) {
  return add_typed(app, names,
                   [&value, &option](std::string_view text) { value = from_typed(text, option); })
      ->description(help_of(value, option))
      ->type_name("N");
}

/// Adds it under the option's key.
template <class Number>
CLI::Option* add_number(CLI::App& app, Number& value, const NumberOption<Number>& option) {
  return add_number(app, "--" + std::string(option.key), value, option);
}

/// Adds an argument for a value of a table, under the table's key; as add_number.
template <class Enumeration>
CLI::Option* add_choice(CLI::App& app, Enumeration& value) {
  return add_typed(
             app, "--" + std::string(EnumerationTable<Enumeration>::key),
             [&value](std::string_view text) { value = from_key<Enumeration>(lower_case(text)); })
      ->description(help_of(value))
      ->type_name("NAME");
}

/// Moves arguments to those that only --help-all shows.
void move_to_finer_settings(CLI::App& app, const std::vector<std::string>& names);

/// Words of a call for the command-line parser.
struct CallWords {
  /// The first word is a command or an option of the program itself.
  std::vector<std::string> words;
  std::string notice;  ///< tells the user which command was added; may be empty
};

/// Adds the command to a call without one. `SCAN OUTPUT` is a remesh. An output with several scans,
/// a folder, a pattern or a list is a batch. `help COMMAND` is `COMMAND --help`, and `-v` is
/// `--version`. Throws CLI::ParseError, with the correct call, for a word that is no command and no
/// file, and for a batch without an output or with a file as output.
CallWords call_words(std::vector<std::string> words, const std::vector<std::string>& commands);

/// Returns a better message than the parser's for an unknown option, with the nearest option's
/// name, and for a missing output; else empty.
std::string refusal_text(const CLI::App& program, const CLI::ParseError& error);

}  // namespace wscvt::program
