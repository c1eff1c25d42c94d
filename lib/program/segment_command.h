// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "toolbox/volume/segmentation.h"
#include "toolbox/volume/volume_choice.h"

namespace wscvt::program {

/// `wscvt segment`: labels the grains of a grey-value volume or a mask.
struct SegmentArguments {
  std::string scan;
  std::string labels;
  std::string page;  ///< empty: beside the labels
  SegmentationOptions options;
  VolumeChoice choice;
  int threads = 0;  ///< 0: all
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, SegmentArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const SegmentArguments& arguments);

}  // namespace wscvt::program
