// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "common_arguments.h"
#include "toolbox/fabric/fabric.h"
#include "toolbox/volume/volume_choice.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt::program {

/// `wscvt describe`: measures a grain, compares it with a reference, or measures the contacts of a
/// volume of labels.
struct DescribeArguments {
  std::string grain;      ///< a mesh, spheres, or a volume of labels
  std::string reference;  ///< a mesh, or the grey values of the labels; empty: none
  std::string folder;     ///< of the contacts
  bool parts = false;     ///< each component of the grain is a convex part
  CommonArguments common;
  DetailedOptions options;
  FabricOptions fabric;
  VolumeChoice choice;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, DescribeArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const DescribeArguments& arguments);

}  // namespace wscvt::program
