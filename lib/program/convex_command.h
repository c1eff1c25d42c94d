// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "common_arguments.h"
#include "toolbox/convex/convex_options.h"
#include "toolbox/exchange/simulation_options.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

/// `wscvt convex`: divides a grain into convex parts.
struct ConvexArguments {
  ConvexArguments();

  std::string scan;
  std::vector<std::string> outputs;  ///< files; the ending selects the format
  ConvexOptions options;
  FrameOptions frame;
  double density = 1.0;
  RemeshOptions remesh;
  CommonArguments common;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, ConvexArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const ConvexArguments& arguments);

}  // namespace wscvt::program
