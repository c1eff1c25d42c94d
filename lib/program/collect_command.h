// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wscvt::program {

/// `wscvt collect`: joins the tables of the parts of a sample.
struct CollectArguments {
  std::vector<std::string> tables;
  std::string output;
  std::vector<std::string> summaries;  ///< files; the ending selects the format
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, CollectArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const CollectArguments& arguments);

}  // namespace wscvt::program
