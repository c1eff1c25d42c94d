// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "output_paths.h"
#include "wscvt/exchange/simulation_files.h"

namespace wscvt::program {

/// Files for a simulation, and the frame that they and the remesh are written in.
struct SimulationArguments {
  std::vector<std::string> nodes;  ///< files; the ending selects the format
  std::vector<std::string> grids;  ///< files of signed distances, likewise
  SimulationOptions options;
};

/// Adds them. Reading a call changes `arguments`, which must outlive `app`.
void add_simulation_arguments(CLI::App& app, SimulationArguments& arguments);

/// The files that the call makes.
std::vector<NamedFile> named_simulation_files(const SimulationArguments& arguments);

/// Throws wscvt::Error for options at odds and for names whose endings say nothing.
void check_simulation_arguments(const SimulationArguments& arguments);

}  // namespace wscvt::program
