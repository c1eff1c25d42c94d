// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation_arguments.h"

#include "command.h"

namespace wscvt::program {

namespace {

void add_files(CLI::App& app, const std::string& name, std::vector<std::string>& files,
               const std::string& description) {
  app.add_option(name, files, description)->type_name("FILE")->allow_extra_args(false);
}

}  // namespace

void add_simulation_arguments(CLI::App& app, SimulationArguments& arguments) {
  add_files(app, "--node-table", arguments.nodes,
            "Write position, normal and area of every node to this .csv, .vtp or .shp\n"
            ".vtp is for ParaView, .shp is a shape for Rockable. May be given more than once");
  add_files(app, "--sdf", arguments.grids,
            "Write signed distances on a grid to this .npy, .vti or .json\n"
            "Distances are negative inside. .npy is a NumPy array with a description in FILE.json, "
            ".vti is for ParaView, .json is a level set for NetDEM. May be given more than once");
  SimulationOptions& options = arguments.options;
  add_choice(app, "--" + std::string(EnumerationTable<Frame>::key), options.frame.frame);
  add_number(app, "--" + std::string(size_option.key), options.frame.size, size_option)
      ->group(finer_settings);
  add_number(app, "--" + std::string(scale_option.key), options.frame.scale, scale_option)
      ->group(finer_settings);
  add_choice(app, "--" + std::string(EnumerationTable<GridSurface>::key), options.surface)
      ->group(finer_settings);
  add_number(app, "--" + std::string(grid_spacing_option.key), options.grid.spacing,
             grid_spacing_option)
      ->group(finer_settings);
}

std::vector<NamedFile> named_simulation_files(const SimulationArguments& arguments) {
  std::vector<NamedFile> files;
  for (const std::string& path : arguments.nodes) files.push_back({"the nodes", path});
  for (const std::string& path : arguments.grids) {
    files.push_back({"the signed distances", path});
    files.push_back({"a description of the signed distances", grid_description_path(path)});
  }
  return files;
}

void check_simulation_arguments(const SimulationArguments& arguments) {
  check_simulation_options(arguments.options);
  for (const std::string& path : arguments.nodes) check_nodes_path(path, arguments.options);
  for (const std::string& path : arguments.grids) check_grid_path(path);
}

}  // namespace wscvt::program
