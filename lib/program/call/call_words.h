// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wscvt::program {

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
