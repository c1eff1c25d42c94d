// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe_command.h"

#include "command.h"
#include "exit_code.h"
#include "toolbox/volume/label_grains.h"

namespace wscvt::program {

CLI::App& add_command(CLI::App& program, DescribeArguments& arguments) {
  CLI::App& app =
      add_command(program, {"describe",
                            "Measure the shape of a grain: size, form, roundness, roughness",
                            {"grain.ply", "grain.stl --report grain.html --report grains.csv"}});
  add_file_argument(app, "grain", arguments.measure.grain,
                    mesh_argument_text("Closed mesh", MeshUse::Read))
      ->required();
  add_typed(app, "--" + std::string(voxel_size_option.key),
            [&arguments](std::string_view text) {
              arguments.measure.voxel_size = from_typed(text, voxel_size_option);
            })
      ->description("Size of a voxel of the scan, " + range_text(voxel_size_option) +
                    ", in the mesh's unit: adds the values without the voxels' error, with "
                    "intervals. For grains of wscvt extract")
      ->type_name("N");
  add_measure_arguments(app, arguments.measure);
  return app;
}

int run(const DescribeArguments& arguments) {
  measure(arguments.measure, {});
  return Done;
}

}  // namespace wscvt::program
