// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "tetrahedra_arguments.h"
#include "toolbox/conforming/conforming_grains.h"
#include "toolbox/job/extract_job.h"

namespace wscvt::program {

/// `wscvt extract`: makes a mesh of each label of a volume, or of each body of a mesh.
struct ExtractArguments {
  std::string input;  ///< a volume or a mesh
  std::string folder;
  std::string smallest;  ///< voxels, or % of the largest body; empty: the job's
  ExtractJob job;
  Shard shard;
  bool conforming = false;         ///< remeshes all labels at once
  ConformingOptions walls;         ///< of that; its smoothing is the job's
  TetrahedraArguments tetrahedra;  ///< of conforming grains
  int threads = 0;
  bool quiet = false;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, ExtractArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const ExtractArguments& arguments);

}  // namespace wscvt::program
