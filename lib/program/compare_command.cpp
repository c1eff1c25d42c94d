// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare_command.h"

#include <utility>

#include "command.h"
#include "exit_code.h"
#include "output_paths.h"
#include "toolbox/report/parts_report.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt::program {

CLI::App& add_command(CLI::App& program, CompareArguments& arguments) {
  CLI::App& app =
      add_command(program, {"compare",
                            "Compare a grain with a reference: shape errors and distances",
                            {"remesh.ply scan.ply", "remesh.ply scan.ply --report difference.html",
                             "clump.csv scan.ply", "remesh.ply scan.ply --parts"},
                            "Both meshes must have the same position: wscvt does not align them."});
  add_file_argument(
      app, "grain", arguments.measure.grain,
      mesh_argument_text("Closed mesh", MeshUse::Read) + "; or a .csv of spheres (wscvt clump)")
      ->required();
  add_file_argument(app, "reference", arguments.reference,
                    "Mesh to which errors and distances are measured")
      ->required();
  add_measure_arguments(app, arguments.measure);
  app.add_flag(
      "--parts", arguments.parts,
      "Measure the distances and volume of convex parts: each component of GRAIN is a part");
  return app;
}

namespace {

void compare_parts(const CompareArguments& arguments) {
  const MeasureArguments& measure = arguments.measure;
  const CommonArguments& common = measure.common;
  checked([&] {
    check_mesh_format(measure.grain, MeshUse::Read);
    check_mesh_format(arguments.reference, MeshUse::Read);
    check_output_paths({{"the parts", measure.grain}, {"the reference", arguments.reference}},
                       named_reports(common.reports), common.overwrite);
    for (const std::string& report : common.reports) check_parts_report(report);
  });
  Work work(common);
  const Execution reading = work.execution().part(0.0, reading_share);
  PartsResult result;
  result.parts = parts_of(read_mesh(measure.grain, reading));
  MeshFile reference = read_mesh_file(arguments.reference, reading);
  result.warnings.assign(reference.warnings.begin(), reference.warnings.end());
  result.grain = check_mesh(std::move(reference.mesh), MeshCheckOptions(), reading).mesh;
  result.measures =
      measure_parts(result.parts, result.grain, work.execution().part(reading_share, 1.0));
  result.scan = describe_shape(result.grain, work.execution().part(1.0, 1.0));
  for (const std::string& name : common.reports) {
    work.write(name, [&](const std::string& path, const Execution& execution) {
      write_report(path, result, origin_of(measure.grain), execution);
    });
  }
  work.print(result.warnings, parts_lines(result));
}

}  // namespace

int run(const CompareArguments& arguments) {
  if (arguments.parts) {
    compare_parts(arguments);
    return Done;
  }
  measure(arguments.measure, arguments.reference);
  return Done;
}

}  // namespace wscvt::program
