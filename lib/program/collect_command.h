// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace wscvt::program {

/// `wscvt collect`: the tables of the parts of a sample become one.
struct CollectArguments {
  std::vector<std::string> tables;
  std::string output;
  std::vector<std::string> summaries;  ///< files; the ending says what each becomes
  bool quiet = false;
};

/// Adds the command to the program. Reading a call changes `arguments`, which must outlive it.
CLI::App& add_command(CLI::App& program, CollectArguments& arguments);

/// Does what the call says; gives the exit code. Throws wscvt::Error.
int run(const CollectArguments& arguments);

}  // namespace wscvt::program
