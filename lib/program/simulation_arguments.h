// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "output_paths.h"
#include "tetrahedra_arguments.h"
#include "toolbox/exchange/simulation_files.h"
#include "toolbox/job/remesh_job.h"

namespace wscvt::program {

/// Files for a simulation, and the frame of these files and of the remesh.
struct SimulationArguments {
  std::vector<std::string> nodes;  ///< files; the ending selects the format
  std::vector<std::string> grids;  ///< files of signed distances; the ending selects the format
  TetrahedraArguments tetrahedra;
  SimulationOptions options;
};

/// Adds the arguments. Parsing changes `arguments`, which must outlive `app`.
void add_simulation_arguments(CLI::App& app, SimulationArguments& arguments);

/// Adds those of many grains, of whose files only the endings are given.
void add_simulation_arguments(CLI::App& app, RemeshJob& job);

/// Returns the files that the call makes.
std::vector<NamedFile> named_simulation_files(const SimulationArguments& arguments);

/// Throws wscvt::Error for options in conflict and for names with unknown endings.
void check_simulation_arguments(const SimulationArguments& arguments);

}  // namespace wscvt::program
