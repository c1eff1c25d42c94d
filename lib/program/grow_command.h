// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "toolbox/job/grow_job.h"

namespace wscvt::program {

/// `wscvt grow`: makes virtual grains with the statistics of a sample.
struct GrowArguments {
  std::vector<std::string> inputs;
  std::string sizes;  ///< file of a size curve; empty: sizes of the sample
  GrowJob job;
  int threads = 0;
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, GrowArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const GrowArguments& arguments);

}  // namespace wscvt::program
