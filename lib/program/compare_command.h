// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "measure_arguments.h"

namespace wscvt::program {

/// `wscvt compare`: the shape of one grain against that of another, and the distances between them.
struct CompareArguments {
  MeasureArguments measure;
  std::string reference;  ///< file
  bool parts = false;     ///< the grain is a file of convex parts
};

/// Adds the command to the program. Reading a call changes `arguments`, which must outlive it.
CLI::App& add_command(CLI::App& program, CompareArguments& arguments);

/// Does what the call says; gives the exit code. Throws wscvt::Error.
int run(const CompareArguments& arguments);

}  // namespace wscvt::program
