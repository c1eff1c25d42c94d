// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wscvt::program {

/// A call as the command-line parser takes it.
struct CallWords {
  /// First the name of a command or an option of the program itself.
  std::vector<std::string> words;
  std::string notice;  ///< a sentence for who did not name the command; may be empty
};

/// Puts in the command that the words of a call leave out. `SCAN OUTPUT` is a remesh; several
/// scans, a folder, a pattern or a list and an output are a batch; `help COMMAND` is `COMMAND
/// --help`, and `-v` is `--version`. Throws CLI::ParseError, with what to type instead, for a word
/// that is no command and no file, and for a batch whose output is missing or is a file.
CallWords call_words(std::vector<std::string> words, const std::vector<std::string>& commands);

/// What is wrong with a call, where the parser has no good words for it: an option that the command
/// does not have, with the one that was perhaps meant, and an output that is missing. Else empty.
std::string refusal_text(const CLI::App& program, const CLI::ParseError& error);

}  // namespace wscvt::program
