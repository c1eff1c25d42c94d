// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "toolbox/fabric/fabric.h"
#include "toolbox/volume/volume_choice.h"

namespace wscvt::program {

/// `wscvt fabric`: measures the contacts of the grains of a volume of labels.
struct FabricArguments {
  std::string labels;
  std::string folder;
  std::string scan;  ///< empty: none
  FabricOptions options;
  VolumeChoice choice;
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, FabricArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const FabricArguments& arguments);

}  // namespace wscvt::program
