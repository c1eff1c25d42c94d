// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "toolbox/sample/templates.h"

namespace wscvt::program {

/// `wscvt templates`: chooses K grains that represent a sample.
struct TemplatesArguments {
  std::vector<std::string> inputs;
  std::string folder;
  std::string format = "ply";
  std::vector<std::string> descriptors;  ///< keys; empty: usual_template_descriptors
  int nodes = 500;
  TemplateOptions options;
  int threads = 0;
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, TemplatesArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const TemplatesArguments& arguments);

}  // namespace wscvt::program
