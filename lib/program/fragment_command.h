// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "common_arguments.h"
#include "tetrahedra_arguments.h"
#include "toolbox/fragment/fragment_options.h"

namespace wscvt::program {

/// `wscvt fragment`: divides a grain into fragments that fill it.
struct FragmentArguments {
  std::string grain;
  std::string folder;
  std::string format = "ply";
  FragmentOptions options;
  std::string sizes;              ///< file of a size curve; empty: about equal
  std::vector<std::string> near;  ///< points, "x,y,z"
  int nodes = 0;                  ///< of each fragment's remesh; 0: its own surface
  double density = 1.0;
  TetrahedraArguments tetrahedra;
  CommonArguments common;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, FragmentArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const FragmentArguments& arguments);

}  // namespace wscvt::program
