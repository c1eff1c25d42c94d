// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

#include "program/arguments/output_paths.h"
#include "program/terminal/work.h"
#include "toolbox/exchange/simulation_files.h"
#include "toolbox/job/remesh_job.h"
#include "toolbox/tetrahedra/tetrahedra.h"

namespace wscvt::program {

/// Files of tetrahedra.
struct TetrahedraArguments {
  std::vector<std::string> files;  ///< the ending selects the format
  double edge = 0.0;               ///< longest wanted, length; 0: as the surface's
};

/// Adds the argument of the files. Parsing changes `arguments`, which must outlive `app`. `filled`:
/// what is filled.
void add_tetrahedra_arguments(CLI::App& app, TetrahedraArguments& arguments,
                              const std::string& filled);

/// Adds the argument of the edge, where no other sets the edges.
void add_tetrahedra_edge(CLI::App& app, TetrahedraArguments& arguments);

/// Throws wscvt::Error for names with unknown endings, and if Gmsh is needed and not there.
void check_tetrahedra_arguments(const TetrahedraArguments& arguments);

/// Makes and writes the tetrahedra that the call asks for. Returns lines for the log.
std::vector<std::string> write_all_tetrahedra(const TetrahedraArguments& arguments, Work& work,
                                              const std::function<TetrahedralMesh()>& make);

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
