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

/// The pages of the program and of its commands, made of their helps. They hold no date, so that
/// they are the same in every build.
std::vector<ManPage> man_pages(const CLI::App& program);

}  // namespace wscvt::program
