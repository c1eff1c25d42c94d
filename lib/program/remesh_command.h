// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "common_arguments.h"
#include "simulation_arguments.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

/// `wscvt remesh`: reads one scan and writes its remesh and reports.
struct RemeshArguments {
  std::string scan;
  std::string output;
  std::string coefficients;  ///< file; empty: no file
  CommonArguments common;
  RemeshOptions options;
  SimulationArguments simulation;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, RemeshArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const RemeshArguments& arguments);

}  // namespace wscvt::program
