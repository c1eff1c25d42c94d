// SPDX-License-Identifier: GPL-3.0-or-later
#include "convex_command.h"

#include <utility>

#include "command.h"
#include "exit_code.h"
#include "help_text.h"
#include "output_paths.h"
#include "remesh_arguments.h"
#include "toolbox/convex/parts.h"
#include "toolbox/exchange/part_files.h"
#include "toolbox/report/parts_report.h"
#include "work.h"
#include "wrong_call.h"

namespace wscvt::program {

ConvexArguments::ConvexArguments() { remesh.node_count = convex_node_count; }

CLI::App& add_command(CLI::App& program, ConvexArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"convex",
       "Divide a grain into convex parts, for physics engines",
       {"scan.ply -k 8 -o parts.obj", "scan.ply -k 4 -o grain.urdf -o grain.xml --density 2650",
        "scan.ply -k 1 --faces 60 -o hull.obj --report hull.html"},
       "The cuts are chosen on a remesh of 500 nodes, with the options of wscvt remesh.\n"
       "The parts are hulls of pieces of the scan.",
       true});
  add_file_argument(app, "scan", arguments.scan, mesh_argument_text("Scan", MeshUse::Read))
      ->required();
  app.add_option("-o,--output", arguments.outputs,
                 "Write the parts to this file: .obj (one group per part), .urdf (with one .obj "
                 "per part beside it) or .xml (MuJoCo). May be given more than once")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->required();
  add_number(app, "-k,--parts", arguments.options.parts, convex_parts_option);
  add_number(app, "--faces", arguments.options.faces, convex_faces_option);
  add_number(app, "--hull-distance", arguments.options.tolerance, convex_tolerance_option);
  add_number(app, "--density", arguments.density, parts_density_option);
  add_choice(app, "--" + std::string(EnumerationTable<Frame>::key), arguments.frame.frame);
  add_number(app, "--" + std::string(size_option.key), arguments.frame.size, size_option);
  add_number(app, "--" + std::string(scale_option.key), arguments.frame.scale, scale_option);
  add_remesh_arguments(app, arguments.remesh);
  add_common_arguments(app, arguments.common);
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name(false, true);
    for (const char* finer : {"--method", "--weighting", "--placement", "--edge-ratio",
                              "--max-error", "--distances", "--threads", "--overwrite"}) {
      if (name.find(finer) != std::string::npos) app.get_option(finer)->group(finer_settings);
    }
  }
  return app;
}

int run(const ConvexArguments& arguments) {
  const CommonArguments& common = arguments.common;
  std::vector<NamedFile> outputs = named_reports(common.reports);
  for (const std::string& output : arguments.outputs) outputs.push_back({"the parts", output});
  checked([&] {
    check_options(arguments.remesh);
    check_options(arguments.options);
    require_in_range(arguments.density, parts_density_option);
    check_frame_options(arguments.frame);
    check_mesh_input(arguments.scan);
    for (const std::string& output : arguments.outputs) check_part_file(output);
    check_output_paths({{"the scan", arguments.scan}}, outputs, common.overwrite);
    for (const std::string& report : common.reports) check_parts_report(report);
  });
  Work work(common);
  MeshFile file = read_mesh_file(arguments.scan, work.execution().part(0.0, reading_share));
  PartsResult result = make_parts(std::move(file.mesh), arguments.remesh, arguments.options,
                                  work.execution().part(reading_share, 1.0));
  result.warnings.insert(result.warnings.begin(), file.warnings.begin(), file.warnings.end());
  const SimulationFrame frame = simulation_frame(result.scan, arguments.frame);
  const MassProperties mass = in_frame(mass_properties(result.scan), frame);
  ConvexParts written = result.parts;
  for (IndexedMesh& part : written) part = in_frame(std::move(part), frame);
  for (const std::string& output : arguments.outputs) {
    work.write(output, [&](const std::string& path, const Execution&) {
      write_parts(path, written, mass, arguments.density);
    });
    const std::string refused = inertia_warning(output, mass, arguments.density);
    if (!refused.empty()) result.warnings.push_back(refused);
  }
  for (const std::string& name : common.reports) {
    work.write(name, [&](const std::string& path, const Execution& execution) {
      write_report(path, result, origin_of(arguments.scan), execution);
    });
  }
  work.print(result.warnings, parts_lines(result));
  return Done;
}

}  // namespace wscvt::program
