// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/arguments/simulation_arguments.h"

#include "program/call/command.h"
#include "toolbox/exchange/tetrahedra_files.h"

namespace wscvt::program {

void add_tetrahedra_arguments(CLI::App& app, TetrahedraArguments& arguments,
                              const std::string& filled) {
  app.add_option("--tetrahedra", arguments.files,
                 "Fill " + filled +
                     " with tetrahedra, for finite elements: .vtu, .msh or .inp\n"
                     ".msh is Gmsh's, .inp is for Abaqus and CalculiX. The surface stays as it is. "
                     "May be given more than once")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

void add_tetrahedra_edge(CLI::App& app, TetrahedraArguments& arguments) {
  add_number(app, arguments.edge, tetrahedra_edge_option)
      ->needs("--tetrahedra")
      ->group(finer_settings);
}

void check_tetrahedra_arguments(const TetrahedraArguments& arguments) {
  for (const std::string& path : arguments.files) check_tetrahedra_file(path);
  require_in_range(arguments.edge, tetrahedra_edge_option);
  if (!arguments.files.empty()) require_tetrahedra();
}

std::vector<std::string> write_all_tetrahedra(const TetrahedraArguments& arguments, Work& work,
                                              const std::function<TetrahedralMesh()>& make) {
  if (arguments.files.empty()) return {};
  const TetrahedralMesh mesh = make();
  for (const std::string& path : arguments.files) {
    work.write(path, [&] { write_tetrahedra(path, mesh); });
  }
  return {tetrahedra_line(mesh)};
}

namespace {

void add_files(CLI::App& app, const std::string& name, const std::string& type,
               std::vector<std::string>& files, const std::string& description) {
  app.add_option(name, files, description + ". May be given more than once")
      ->type_name(type)
      ->allow_extra_args(false);
}

void add_options(CLI::App& app, SimulationOptions& options) {
  add_choice(app, options.frame.frame);
  add_number(app, options.frame.size, size_option)->group(finer_settings);
  add_number(app, options.frame.scale, scale_option)->group(finer_settings);
  add_number(app, options.grid.spacing, grid_spacing_option)->needs("--sdf")->group(finer_settings);
}

}  // namespace

void add_simulation_arguments(CLI::App& app, SimulationArguments& arguments) {
  add_files(app, "--node-table", "FILE", arguments.nodes,
            "Write position, normal and area of every node to this .csv, .vtp or .shp\n"
            ".vtp is for ParaView, .shp is a shape for Rockable");
  add_files(app, "--sdf", "FILE", arguments.grids,
            "Write signed distances to the repaired scan, on a grid, to this .npy, .vti or .json\n"
            "Distances are negative inside. .npy is a NumPy array with a description in FILE.json, "
            ".vti is for ParaView, .json is a level set for NetDEM, positive inside");
  add_tetrahedra_arguments(app, arguments.tetrahedra, "the remesh");
  add_tetrahedra_edge(app, arguments.tetrahedra);
  add_options(app, arguments.options);
}

void add_simulation_arguments(CLI::App& app, RemeshJob& job) {
  add_files(app, "--node-table", "NAME", job.node_tables,
            "Write position, normal and area of every node, one file per grain in "
            "OUT/node-table: csv, vtp or shp");
  add_files(
      app, "--sdf", "NAME", job.grids,
      "Write grids of distances to the repaired scan, one file per grain in OUT/sdf: npy, vti "
      "or json");
  add_options(app, job.simulation);
}

std::vector<NamedFile> named_simulation_files(const SimulationArguments& arguments) {
  std::vector<NamedFile> files;
  for (const std::string& path : arguments.nodes) files.push_back({"the nodes", path});
  for (const std::string& path : arguments.grids) {
    files.push_back({"the signed distances", path});
    files.push_back({"a description of the signed distances", grid_description_path(path)});
  }
  for (const std::string& path : arguments.tetrahedra.files) {
    files.push_back({"the tetrahedra", path});
  }
  return files;
}

void check_simulation_arguments(const SimulationArguments& arguments) {
  check_simulation_options(arguments.options);
  for (const std::string& path : arguments.nodes) check_nodes_path(path, arguments.options);
  for (const std::string& path : arguments.grids) check_grid_path(path);
  check_tetrahedra_arguments(arguments.tetrahedra);
}

}  // namespace wscvt::program
