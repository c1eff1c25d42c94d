// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "common_arguments.h"
#include "wscvt/clump/clump_options.h"
#include "wscvt/exchange/simulation_options.h"

namespace wscvt::program {

/// `wscvt clump`: a clump of spheres of one grain.
struct ClumpArguments {
  std::string scan;
  std::vector<std::string> outputs;  ///< the ending says what each becomes
  ClumpOptions options;
  FrameOptions frame;
  CommonArguments common;
};

/// Adds the command to the program. Reading a call changes `arguments`, which must outlive it.
CLI::App& add_command(CLI::App& program, ClumpArguments& arguments);

/// Does what the call says; gives the exit code. Throws wscvt::Error.
int run(const ClumpArguments& arguments);

}  // namespace wscvt::program
