// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wscvt::program {

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
