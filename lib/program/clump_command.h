// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "common_arguments.h"
#include "toolbox/clump/clump_options.h"
#include "toolbox/exchange/simulation_options.h"
#include "toolbox/job/grain_files.h"

namespace wscvt::program {

/// `wscvt clump`: makes a clump of spheres of one grain, or of each grain of a sample.
struct ClumpArguments {
  std::vector<std::string> inputs;   ///< a scan, or inputs as of a batch
  std::vector<std::string> outputs;  ///< files, the ending selects the format; or one folder
  std::string format = "csv";        ///< of a sample: ending of the clumps
  Shard shard;                       ///< of a sample
  ClumpOptions options;
  FrameOptions frame;
  double density = 1.0;  ///< of .molecule
  CommonArguments common;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, ClumpArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const ClumpArguments& arguments);

}  // namespace wscvt::program
