// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "common_arguments.h"
#include "simulation_arguments.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

/// `wscvt remesh`: one scan in, one remesh and its reports out.
struct RemeshArguments {
  std::string scan;
  std::string output;
  std::string coefficients;  ///< file; empty: none
  CommonArguments common;
  RemeshOptions options;
  SimulationArguments simulation;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, RemeshArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const RemeshArguments& arguments);

}  // namespace wscvt::program
