// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "toolbox/job/grow_job.h"
#include "toolbox/job/template_job.h"

namespace wscvt::program {

/// `wscvt grow`: makes virtual grains with the statistics of a sample, or chooses templates.
struct GrowArguments {
  std::vector<std::string> inputs;
  std::string sizes;       ///< file of a size curve; empty: sizes of the sample
  bool templates = false;  ///< chooses real grains instead
  GrowJob job;
  TemplateJob choice;        ///< of templates, with the job's folder, shard, format and nodes
  std::optional<int> count;  ///< of grains; empty: the default of the job
  int threads = 0;
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, GrowArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const GrowArguments& arguments);

}  // namespace wscvt::program
