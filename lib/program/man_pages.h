// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wscvt::program {

/// A manual page, in roff.
struct ManPage {
  std::string file;  ///< "wscvt-remesh.1"
  std::string text;
};

/// Returns the pages of the program and of its commands, made from their helps. They contain no
/// date, so that every build makes the same pages.
std::vector<ManPage> man_pages(const CLI::App& program);

}  // namespace wscvt::program
