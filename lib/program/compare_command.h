// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "measure_arguments.h"

namespace wscvt::program {

/// `wscvt compare`: compares the shapes of two grains and measures the distances between them.
struct CompareArguments {
  MeasureArguments measure;
  std::string reference;  ///< file
  bool parts = false;     ///< the grain is a file of convex parts
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, CompareArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const CompareArguments& arguments);

}  // namespace wscvt::program
