// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "common_arguments.h"

namespace wscvt::program {

/// `wscvt split`: writes each body of a mesh file to its own file.
struct SplitArguments {
  std::string mesh;
  std::string folder;
  std::string format = "ply";
  double smallest = 0.0;  ///< % of the largest body's volume
  CommonArguments common;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, SplitArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const SplitArguments& arguments);

}  // namespace wscvt::program
