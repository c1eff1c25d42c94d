// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "toolbox/job/grain_files.h"
#include "toolbox/report/shape_table.h"
#include "toolbox/volume/label_grains.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

/// `wscvt batch`: remeshes the grains of a sample, one grain per thread, and writes a table and a
/// summary.
struct BatchArguments {
  std::vector<std::string> inputs;
  std::string folder;          ///< of the output
  std::string format = "ply";  ///< ending of the meshes
  Shard shard;
  bool seconds = false;  ///< the table has a column with the run time of each grain
  int threads = 0;       ///< 0: all
  bool quiet = false;
  RemeshOptions options;
  std::vector<int> levels;  ///< several numbers of nodes, ascending; empty for one number
  ShapeMeasures shapes;     ///< of shape.csv
  VolumeOptions volume;     ///< of inputs that are volumes
};

/// Adds the options of a sample: shard, format, seconds, and the remesh of its grains.
void add_sample_arguments(CLI::App& app, BatchArguments& arguments);

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, BatchArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const BatchArguments& arguments);

}  // namespace wscvt::program
