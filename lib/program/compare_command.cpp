// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare_command.h"

#include "command.h"
#include "exit_code.h"

namespace wscvt::program {

CLI::App& add_command(CLI::App& program, CompareArguments& arguments) {
  CLI::App& app =
      add_command(program, {"compare",
                            "Measure a grain against another: errors of shape, distances",
                            {"remesh.ply scan.ply", "remesh.ply scan.ply --report difference.html",
                             "clump.csv scan.ply"},
                            "Both must stand in the same place: nothing is moved to fit."});
  add_file_argument(
      app, "grain", arguments.measure.grain,
      mesh_argument_text("Closed mesh", MeshUse::Read) + "; or a .csv of spheres (wscvt clump)")
      ->required();
  add_file_argument(app, "reference", arguments.reference,
                    "The mesh that errors and distances are measured against")
      ->required();
  add_measure_arguments(app, arguments.measure);
  return app;
}

int run(const CompareArguments& arguments) {
  measure(arguments.measure, arguments.reference);
  return Done;
}

}  // namespace wscvt::program
