// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "common_arguments.h"
#include "grain_inputs.h"
#include "toolbox/job/engine_jobs.h"

namespace wscvt::program {

/// `wscvt convex`: divides a grain, or each grain of a sample, into convex parts.
struct ConvexArguments {
  ScanInputs sample;
  std::vector<std::string> outputs;  ///< files, the ending selects the format; or one folder
  ConvexJob job;
  CommonArguments common;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, ConvexArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const ConvexArguments& arguments);

}  // namespace wscvt::program
