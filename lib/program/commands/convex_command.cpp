// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/grain_inputs.h"
#include "program/arguments/output_paths.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/call/help_text.h"
#include "program/commands/commands.h"
#include "program/terminal/work.h"
#include "toolbox/convex/convex_parts.h"
#include "toolbox/exchange/part_files.h"
#include "toolbox/job/engine_jobs.h"
#include "toolbox/report/parts_report.h"
#include "wscvt/base/text.h"

namespace wscvt::program {

namespace {

/// `wscvt convex`: divides a grain, or each grain of a sample, into convex parts.
struct ConvexArguments {
  ScanInputs sample;
  std::vector<std::string> outputs;  ///< files, the ending selects the format; or one folder
  ConvexJob job;
  CommonArguments common;
};

CLI::App& add_arguments(CLI::App& program, ConvexArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"convex",
       "Divide a grain into convex parts, for physics engines",
       {"scan.ply -k 8 -o parts.obj", "scan.ply -k 4 -o grain.urdf -o grain.xml --density 2650",
        "scan.ply -k 1 --faces 60 -o hull.obj --report hull.html",
        "scans -k 4 --faces 60 -o bodies --size 0.02 --engine mujoco"},
       "The parts are hulls of pieces of the scan, scaled together so that they keep the grain's "
       "volume.",
       true,
       true});
  app.add_option("-o,--output", arguments.outputs,
                 "Write the parts to this file: .obj (one group per part), .urdf (with one .obj "
                 "per part beside it), .xml (MuJoCo) or .shp (Rockable). May be given more than "
                 "once. For several scans: folder of the parts and of the table grains.csv")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->required();
  add_scan_inputs(app, arguments.sample, "parts", arguments.job.format, EngineShapes::Parts);
  add_number(app, "-k,--count", arguments.job.convex.parts, convex_parts_option);
  add_number(app, "--faces", arguments.job.convex.faces, convex_faces_option);
  add_number(app, "--max-error", arguments.job.convex.tolerance, convex_tolerance_option);
  arguments.sample.density =
      add_number(app, "--density", arguments.job.density, parts_density_option);
  tell_density_of_packing(*app.get_option("--density"));
  add_choice(app, arguments.job.frame.frame);
  add_number(app, arguments.job.frame.size, size_option);
  add_number(app, arguments.job.frame.scale, scale_option);
  add_remesh_arguments(app, arguments.job.remesh, Remeshed::Parts);
  app.get_option("--nodes")->description(
      help_of(arguments.job.remesh.node_count, convex_nodes_option));
  add_common_arguments(app, arguments.common);
  move_to_finer_settings(app, {"--frame", "--scale", "--threads"});
  return app;
}

int run(const ConvexArguments& arguments) {
  const CommonArguments& common = arguments.common;
  ConvexJob job = arguments.job;
  checked([&] {
    check_job(job);
    check_engine_inputs(arguments.sample, EngineShapes::Parts, job.format, job.frame);
    if (arguments.sample.engine == "yade" && job.convex.parts > 1) {
      refuse("Yade takes one convex polyhedron for a grain. Give -k 1.");
    }
  });
  if (arguments.sample.is_sample()) {
    checked([&] {
      check_sample_outputs(arguments.outputs, common.reports, "parts", [](const std::string& path) {
        const std::vector<std::string>& endings = part_endings();
        return std::count(endings.begin(), endings.end(), ending_of(path)) > 0;
      });
    });
    return run_sample(arguments.sample,
                      make_job(job, arguments.outputs.front(), arguments.sample.shard),
                      EngineShapes::Parts, job.frame, job.density, common.threads, common.quiet);
  }
  const std::string& scan = arguments.sample.inputs.front();
  std::vector<NamedFile> outputs = named_reports(common.reports);
  for (const std::string& output : arguments.outputs) {
    outputs.push_back({"the parts", output});
    for (const std::string& part : parts_beside(output, job.convex.parts)) {
      outputs.push_back({"a part of \"" + output + "\"", part});
    }
  }
  checked([&] {
    check_one_scan(arguments.sample);
    check_mesh_input(scan);
    for (const std::string& output : arguments.outputs) check_part_file(output);
    check_output_paths({{"the scan", scan}}, outputs);
    for (const std::string& report : common.reports) check_parts_report(report);
  });
  Work work(common.threads, common.quiet);
  MeshFile file = read_mesh_file(scan, work.execution().part(0.0, reading_share));
  PartsResult result = make_parts(std::move(file.mesh), job.remesh, job.convex,
                                  work.execution().part(reading_share, 1.0));
  result.warnings.insert(result.warnings.begin(), file.warnings.begin(), file.warnings.end());
  std::vector<Rounding> roundings;
  for (const std::string& output : arguments.outputs) {
    work.write(output, [&] {
      const WrittenParts written = write_parts(output, result, job.frame, job.density);
      if (!written.warning.empty()) result.warnings.push_back(written.warning);
      roundings.push_back(written.rounding);
    });
  }
  work.write_reports(common.reports, result, origin_of(scan));
  std::vector<std::string> lines = parts_lines(result);
  const std::vector<std::string> rounded = rounding_lines(roundings);
  lines.insert(lines.end(), rounded.begin(), rounded.end());
  work.print(result.warnings, lines);
  return Done;
}

}  // namespace

Command convex_command(CLI::App& program) { return make_command<ConvexArguments>(program); }

}  // namespace wscvt::program
