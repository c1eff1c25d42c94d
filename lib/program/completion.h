// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace wscvt::program {

/// Returns a script with which bash completes commands, options, and named values of options.
/// Everything else completes to files.
std::string bash_completion(const CLI::App& program);

}  // namespace wscvt::program
