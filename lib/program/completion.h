// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace wscvt::program {

/// A script that teaches bash the program's commands, their options and, of options with names for
/// values, those. Files complete where nothing else does.
std::string bash_completion(const CLI::App& program);

}  // namespace wscvt::program
