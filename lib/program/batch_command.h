// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "batch_inputs.h"
#include "volume/label_grains.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/report/shape_table.h"

namespace wscvt::program {

/// `wscvt batch`: the grains of a sample, one a thread, and a table and a summary of them.
struct BatchArguments {
  BatchArguments();

  std::vector<std::string> inputs;
  std::string folder;          ///< of the output
  std::string format = "ply";  ///< ending of the meshes
  Shard shard;
  bool seconds = false;  ///< a column of the table says how long each grain took
  int threads = 0;       ///< 0: all
  bool quiet = false;
  RemeshOptions options;    ///< without advice, which is for a person at one grain
  std::vector<int> levels;  ///< numbers of nodes if there are several, ascending; else empty
  ShapeMeasures shapes;     ///< of the table of shapes
  VolumeOptions volume;     ///< of inputs that are volumes
};

/// Adds what is asked of a sample as a whole: shard, format, seconds, and the remesh of its grains.
void add_sample_arguments(CLI::App& app, BatchArguments& arguments);

/// Adds the command to the program. Reading a call changes `arguments`, which must outlive it.
CLI::App& add_command(CLI::App& program, BatchArguments& arguments);

/// Does what the call says; gives the exit code. Throws wscvt::Error.
int run(const BatchArguments& arguments);

}  // namespace wscvt::program
