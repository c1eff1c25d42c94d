// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "help_text.h"
#include "wscvt/base/error.h"
#include "wscvt/base/lower_case.h"

namespace wscvt::program {

/// What a command is called and what its help says beside its options.
struct CommandText {
  std::string name;
  std::string purpose;                ///< one line
  std::vector<std::string> examples;  ///< calls, without "wscvt" and the name
  std::string notes = {};             ///< lines below the examples; may be empty
  bool has_finer_settings = false;    ///< that only --help-all shows
  bool some_may_fail = false;         ///< of many grains: exit code SomeFailed
};

/// What the exit codes are; every help ends with it.
std::string exit_code_text(bool some_may_fail);

/// Adds a command to the program; its arguments are for the caller to add.
CLI::App& add_command(CLI::App& program, const CommandText& text);

/// Adds an argument whose text `read` takes; what that throws as wscvt::Error refuses the call.
/// `names` as CLI11 takes them: "-n,--nodes". Of one given twice the later counts.
CLI::Option* add_typed(CLI::App& app, const std::string& names,
                       const std::function<void(std::string_view)>& read);

/// Adds the file or folder that is made: the last of the words, `name`, or -o. Reading a call
/// changes `path`, which must outlive `app`.
CLI::Option* add_output(CLI::App& app, const std::string& name, std::string& path,
                        const std::string& description, const std::string& type = "FILE");

/// An argument for a number. Reading a call changes `value`, which must outlive `app`, and so must
/// `option`.
template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& names, Number& value,
                        const NumberOption<Number>& option) {
  return add_typed(app, names,
                   [&value, &option](std::string_view text) { value = from_typed(text, option); })
      ->description(help_of(value, option))
      ->type_name("N");
}

/// An argument for one of a table's values; as add_number.
template <class Enumeration>
CLI::Option* add_choice(CLI::App& app, const std::string& names, Enumeration& value) {
  return add_typed(
             app, names,
             [&value](std::string_view text) { value = from_key<Enumeration>(lower_case(text)); })
      ->description(help_of(value))
      ->type_name("NAME");
}

}  // namespace wscvt::program
