// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "toolbox/conforming/conforming_grains.h"
#include "volume_arguments.h"

namespace wscvt::program {

/// `wscvt extract`: makes a dense mesh of each grain of a volume of labels.
struct ExtractArguments {
  std::string volume;
  VolumeOptions options;
  std::string folder;
  std::string format = "ply";
  bool conforming = false;
  ConformingOptions walls;  ///< of conforming grains
  int threads = 0;          ///< 0: all
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, ExtractArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const ExtractArguments& arguments);

}  // namespace wscvt::program
