// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace wscvt::program {

/// The words of a call as the command-line parser takes them, first the name of a command or an
/// option of the program itself. `SCAN OUTPUT` is a remesh, `help COMMAND` is `COMMAND --help`, and
/// `-v` is `--version`. Throws CLI::ParseError, with what to type instead, for a word that is no
/// command and no file, a folder, and several scans.
std::vector<std::string> call_words(std::vector<std::string> words,
                                    const std::vector<std::string>& commands);

}  // namespace wscvt::program
