// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "toolbox/job/remesh_job.h"

namespace wscvt::program {

/// `wscvt batch`: remeshes the grains of a sample, one grain per thread, and writes a table and a
/// summary.
struct BatchArguments {
  std::vector<std::string> inputs;
  std::string folder;  ///< of the output
  Shard shard;
  int threads = 0;  ///< 0: all
  bool quiet = false;
  RemeshJob job;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, BatchArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const BatchArguments& arguments);

}  // namespace wscvt::program
