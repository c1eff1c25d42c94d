// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <string>
#include <utility>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/grain_inputs.h"
#include "program/arguments/output_paths.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/work.h"
#include "toolbox/clump/clump.h"
#include "toolbox/exchange/clump_files.h"
#include "toolbox/job/engine_jobs.h"
#include "toolbox/report/clump_report.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::program {

namespace {

/// `wscvt clump`: makes a clump of spheres of one grain, or of each grain of a sample.
struct ClumpArguments {
  ScanInputs sample;
  std::vector<std::string> outputs;  ///< files, the ending selects the format; or one folder
  ClumpJob job;
  const CLI::Option* count = nullptr;  ///< of spheres

  bool is_count_given() const { return count != nullptr && count->count() > 0; }
  CommonArguments common;
};

/// Adds an argument for each option of a clump, under its key.
struct AddClumpOption {
  CLI::App& app;

  template <class Number>
  void operator()(Number& value, const NumberOption<Number>& option) {
    const std::string letter = option.key == sphere_count_option.key ? "-k," : "";
    add_number(app, letter + "--" + std::string(option.key), value, option);
  }
  void operator()(ClumpError& value) { add_choice(app, value); }
  void operator()(bool& value, const FlagOption& option) {
    app.add_flag("--" + std::string(option.key), value, help_of(value, option));
  }
};

CLI::App& add_arguments(CLI::App& program, ClumpArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"clump",
       "Fit overlapping spheres to a grain, for engines that use clumps",
       {"scan.ply -k 20 -o clump.csv --report clump.html",
        "scan.ply --max-error 3 -o clump.multisphere -o clump.chrono.csv --size 0.01",
        "scan.ply -k 20 --inside -o clump.py", "scans -k 10 -o run --size 0.02 --engine lammps"},
       "Mass, centre and inertia are the grain's. The report has the errors of the spheres' "
       "own values.\nwscvt describe clump.csv scan.ply measures a clump.",
       true,
       true});
  app.add_option("-o,--output", arguments.outputs,
                 "Write the clump to this file. Endings: .csv (x,y,z,r), .multisphere (LIGGGHTS), "
                 ".py (Yade), .chrono.csv (Chrono DEM-Engine), .mclump (a folder for MercuryDPM), "
                 ".p3dat (PFC), .molecule (LAMMPS), .clu (Kratos). May be given more than once. "
                 "For several "
                 "scans: folder of the clumps and of the table grains.csv")
      ->type_name("FILE")
      ->required()
      ->allow_extra_args(false);
  add_scan_inputs(app, arguments.sample, "clumps", arguments.job.format, EngineShapes::Clumps);
  AddClumpOption add{app};
  for_each_clump_option(arguments.job.clump, add);
  CLI::Option* count = app.get_option("--count");
  count->description("Number of spheres, " + range_text(sphere_count_option) +
                     ": exactly this many; with an allowed error, at most. Default: " +
                     typed_text(arguments.job.clump.sphere_count) + ", with an allowed error " +
                     typed_text(arguments.job.clump.most_spheres));
  arguments.count = count;
  move_to_finer_settings(app, {"--points", "--shrink-wrap", "--max-repaired-area"});
  add_choice(app, arguments.job.frame.frame)->group(finer_settings);
  add_number(app, arguments.job.frame.size, size_option);
  add_number(app, arguments.job.frame.scale, scale_option)->group(finer_settings);
  arguments.sample.density =
      add_number(app, arguments.job.density, clump_density_option)->group(finer_settings);
  tell_density_of_packing(*app.get_option("--density"));
  add_common_arguments(app, arguments.common);
  move_to_finer_settings(app, {"--threads", "--quiet"});
  return app;
}

int run(const ClumpArguments& arguments) {
  const CommonArguments& common = arguments.common;
  ClumpJob job = arguments.job;
  if (arguments.is_count_given()) job.clump.most_spheres = job.clump.sphere_count;
  checked([&] {
    check_job(job);
    check_engine_inputs(arguments.sample, EngineShapes::Clumps, job.format, job.frame);
  });
  if (arguments.sample.is_sample()) {
    checked(
        [&] { check_sample_outputs(arguments.outputs, common.reports, "clumps", is_clump_name); });
    return run_sample(arguments.sample,
                      make_job(job, arguments.outputs.front(), arguments.sample.shard),
                      EngineShapes::Clumps, job.frame, job.density, common.threads, common.quiet);
  }
  const std::string& scan = arguments.sample.inputs.front();
  checked([&] {
    check_one_scan(arguments.sample);
    refuse_spheres(scan);
    check_mesh_format(scan, MeshUse::Read);
    std::vector<NamedFile> outputs = named_reports(common.reports);
    for (const std::string& output : arguments.outputs) {
      check_clump_path(output);
      for (const std::string& file : files_of_clump(output)) {
        if (file.rfind(output + "/", 0) != 0) outputs.push_back({"the clump", file});
      }
    }
    check_output_paths({{"the scan", scan}}, outputs);
    for (const std::string& report : common.reports) check_clump_report(report);
  });
  Work work(common.threads, common.quiet);
  MeshFile file = read_mesh_file(scan, work.execution().part(0.0, reading_share));
  ClumpResult clump =
      make_clump(std::move(file.mesh), job.clump, work.execution().part(reading_share, 1.0));
  clump.warnings.insert(clump.warnings.begin(), file.warnings.begin(), file.warnings.end());
  for (const std::string& output : arguments.outputs) {
    work.write(output, [&] { write_clump(output, clump, job.frame, job.density); });
  }
  work.write_reports(common.reports, clump, origin_of(scan));
  work.print(clump.warnings, clump_lines(clump));
  return Done;
}

}  // namespace

Command clump_command(CLI::App& program) { return make_command<ClumpArguments>(program); }

}  // namespace wscvt::program
