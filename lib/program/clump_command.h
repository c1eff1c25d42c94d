// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "common_arguments.h"
#include "grain_inputs.h"
#include "toolbox/job/engine_jobs.h"

namespace wscvt::program {

/// `wscvt clump`: makes a clump of spheres of one grain, or of each grain of a sample.
struct ClumpArguments {
  ScanInputs sample;
  std::vector<std::string> outputs;  ///< files, the ending selects the format; or one folder
  ClumpJob job;
  const CLI::Option* count = nullptr;  ///< of spheres

  bool is_count_given() const { return count != nullptr && count->count() > 0; }
  CommonArguments common;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, ClumpArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const ClumpArguments& arguments);

}  // namespace wscvt::program
