// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "toolbox/sample/detail_levels.h"
#include "toolbox/sample/grain_sample.h"

namespace wscvt::program {

/// `wscvt sample`: computes the statistics of a sample, or compares two samples.
struct SampleArguments {
  std::vector<std::string> samples;  ///< folders of a batch, or tables; one or two
  SampleOptions options;
  std::vector<double> densities;  ///< one for all samples, or one per sample; may be empty
  double mark_percent = usual_mark_percent;  ///< of levels
  std::vector<std::string> reports;          ///< files; the ending selects the format
  int threads = 0;                           ///< 0: all
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, SampleArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const SampleArguments& arguments);

}  // namespace wscvt::program
