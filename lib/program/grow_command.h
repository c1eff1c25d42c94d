// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "toolbox/sample/grow_options.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt::program {

/// `wscvt grow`: makes virtual grains with the statistics of a sample.
struct GrowArguments {
  std::vector<std::string> inputs;
  std::string folder;
  std::string format = "ply";
  std::string sizes;  ///< file of a size curve; empty: sizes of the sample
  bool coefficients = false;
  int grains = 1000;
  int nodes = 500;
  int degree = usual_harmonic_degree;
  GrowOptions options;
  int threads = 0;
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, GrowArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const GrowArguments& arguments);

}  // namespace wscvt::program
