// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "common_arguments.h"
#include "wscvt/convex/convex_options.h"
#include "wscvt/exchange/simulation_options.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

/// `wscvt convex`: a scan in, convex parts out.
struct ConvexArguments {
  ConvexArguments();

  std::string scan;
  std::vector<std::string> outputs;  ///< files; the ending says what each becomes
  ConvexOptions options;
  FrameOptions frame;
  double density = 1.0;
  RemeshOptions remesh;
  CommonArguments common;
};

/// Adds the command to the program. Reading a call changes `arguments`, which must outlive it.
CLI::App& add_command(CLI::App& program, ConvexArguments& arguments);

/// Does what the call says; gives the exit code. Throws wscvt::Error.
int run(const ConvexArguments& arguments);

}  // namespace wscvt::program
