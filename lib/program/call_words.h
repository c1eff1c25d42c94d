// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wscvt::program {

/// The words of a call as the command-line parser takes them, first the name of a command or an
/// option of the program itself. `SCAN OUTPUT` is a remesh, `help COMMAND` is `COMMAND --help`, and
/// `-v` is `--version`. Throws CLI::ParseError, with what to type instead, for a word that is no
/// command and no file, a folder, and several scans.
std::vector<std::string> call_words(std::vector<std::string> words,
                                    const std::vector<std::string>& commands);

/// What is wrong with a call, where the parser has no good words for it: an option that the command
/// does not have, with the one that was perhaps meant, and an output that is missing. Else empty.
std::string refusal_text(const CLI::App& program, const CLI::ParseError& error);

}  // namespace wscvt::program
