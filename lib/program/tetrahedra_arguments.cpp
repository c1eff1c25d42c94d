// SPDX-License-Identifier: GPL-3.0-or-later
#include "tetrahedra_arguments.h"

#include "command.h"
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
  add_number(app, "--" + std::string(tetrahedra_edge_option.key), arguments.edge,
             tetrahedra_edge_option)
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
    work.write(path,
               [&](const std::string& name, const Execution&) { write_tetrahedra(name, mesh); });
  }
  return {tetrahedra_line(mesh)};
}

}  // namespace wscvt::program
