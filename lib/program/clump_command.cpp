// SPDX-License-Identifier: GPL-3.0-or-later
#include "clump_command.h"

#include <utility>

#include "command.h"
#include "exit_code.h"
#include "grain_inputs.h"
#include "job_on_terminal.h"
#include "output_paths.h"
#include "signals.h"
#include "toolbox/clump/clump.h"
#include "toolbox/exchange/clump_files.h"
#include "toolbox/report/clump_json.h"
#include "toolbox/report/clump_report.h"
#include "toolbox/report/sample_table.h"
#include "toolbox/volume/open_volume.h"
#include "volume_arguments.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::program {

namespace {

/// Adds an argument for each option of a clump, under its key.
struct AddClumpOption {
  CLI::App& app;

  template <class Number>
  void operator()(Number& value, const NumberOption<Number>& option) {
    const bool is_count = option.key == sphere_count_option.key;
    add_number(app, (is_count ? "-k,--" : "--") + std::string(option.key), value, option);
  }
  void operator()(bool& value, const FlagOption& option) {
    app.add_flag("--" + std::string(option.key), value, help_of(value, option));
  }
};

}  // namespace

CLI::App& add_command(CLI::App& program, ClumpArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"clump",
       "Fit overlapping spheres to a grain, for engines that use clumps",
       {"scan.ply -k 20 -o clump.csv --report clump.html",
        "scan.ply --max-error 3 -o clump.multisphere -o clump.chrono.csv --size 0.01",
        "scan.ply -k 50 --inside -o clump.py", "scans -k 10 -o clumps"},
       "Mass, centre and inertia are the grain's. The report has the errors of the spheres' "
       "own values.\nwscvt compare clump.csv scan.ply measures a clump.",
       true,
       true});
  app.add_option(
         "scans", arguments.inputs,
         mesh_argument_text("Scan", MeshUse::Read) +
             "; or several scans, folders, patterns in quotes, volumes of labels, or @FILE with "
             "one of these per line")
      ->type_name("INPUT")
      ->required();
  app.add_option("-o,--output", arguments.outputs,
                 "Write the clump to this file. Endings: .csv (x,y,z,r), .multisphere (LIGGGHTS), "
                 ".py (Yade), .chrono.csv (Chrono DEM-Engine), .mclump (a folder for MercuryDPM), "
                 ".p3dat (PFC), .molecule (LAMMPS). May be given more than once. For several "
                 "scans: folder of the clumps and of the table grains.csv")
      ->type_name("FILE")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--format", arguments.format,
                 "Ending of the clumps of several scans, without the point. Default: csv")
      ->type_name("NAME")
      ->group(finer_settings);
  add_typed(app, "--shard",
            [&arguments](std::string_view text) { arguments.shard = shard_of(text); })
      ->description("Use only part I of N of several scans, selected by their names")
      ->type_name("I/N")
      ->group(finer_settings);
  AddClumpOption add{app};
  for_each_clump_option(arguments.options, add);
  for (const std::string_view key : {points_option.key, shrink_wrap_option.key,
                                     repaired_area_limit_option.key, most_spheres_option.key}) {
    app.get_option("--" + std::string(key))->group(finer_settings);
  }
  add_choice(app, "--" + std::string(EnumerationTable<Frame>::key), arguments.frame.frame)
      ->group(finer_settings);
  add_number(app, "--" + std::string(size_option.key), arguments.frame.size, size_option);
  add_number(app, "--" + std::string(scale_option.key), arguments.frame.scale, scale_option)
      ->group(finer_settings);
  add_number(app, "--" + std::string(clump_density_option.key), arguments.density,
             clump_density_option)
      ->group(finer_settings);
  add_common_arguments(app, arguments.common);
  for (const char* name : {"--threads", "--overwrite", "--quiet"}) {
    app.get_option(name)->group(finer_settings);
  }
  return app;
}

namespace {

/// Returns whether the inputs are a sample, that is, anything except one mesh file.
bool is_sample(const std::vector<std::string>& inputs) {
  return inputs.size() > 1 || names_files(inputs.front()) || is_volume(inputs.front());
}

/// Returns the options that must be equal when a sample is started again.
std::string call_text(const ClumpArguments& arguments) {
  return json_document({{"format", "wscvt-clumps"},
                        {"made_by", made_by()},
                        {"clumps", arguments.format},
                        {"frame", key_of(arguments.frame.frame)},
                        {"size", arguments.frame.size},
                        {"scale", arguments.frame.scale},
                        {"density", arguments.density},
                        {"options", json_of(arguments.options)}});
}

/// Returns the job of a sample.
GrainJob clump_job(const ClumpArguments& arguments) {
  GrainJob job;
  job.folder = arguments.outputs.front();
  job.shard = arguments.shard;
  job.ending = arguments.format;
  job.call = call_text(arguments);
  job.tables = {{"grains", sample_header(clump_csv(ClumpResult()), false)}};
  job.make = [&arguments](GrainAtWork& grain) -> std::vector<std::string> {
    ClumpResult clump = make_clump(std::move(grain.scan.mesh), arguments.options, grain.execution);
    clump.warnings.insert(clump.warnings.begin(), grain.scan.warnings.begin(),
                          grain.scan.warnings.end());
    write_clump(grain.folders.front().file_of(grain.name), clump, arguments.frame,
                arguments.density);
    return {sample_row(grain.name, clump_csv(clump, {grain.name, ""}), {})};
  };
  job.failed = [](const std::string& grain, const std::string& error,
                  double) -> std::vector<std::string> {
    return {failed_row(grain, error, clump_csv(ClumpResult()), {})};
  };
  return job;
}

int run_sample(const ClumpArguments& arguments) {
  const bool quiet = arguments.common.quiet;
  const std::vector<std::string> files = checked([&] {
    if (arguments.outputs.size() != 1 || is_clump_name(arguments.outputs.front())) {
      refuse("Several scans are given. Give one folder with -o, and --format for the clumps.");
    }
    if (!arguments.common.reports.empty()) {
      refuse(
          "Several scans are given. Their table is grains.csv in the folder of -o. Leave out "
          "--report.");
    }
    check_clump_path("clump." + arguments.format);
    return input_files(arguments.inputs);
  });
  const std::unique_ptr<GrainSource> inputs = open_inputs(files, {}, arguments.shard, quiet);
  const GrainJob job = clump_job(arguments);
  const JobEnd end = run_job(job, *inputs, arguments.common.threads, quiet);
  if (end.was_cancelled()) return 128 + noted_signal();
  print({std::to_string(end.done) + " grains, " + std::to_string(end.failed) +
         " failed: " + folders_of(job).front().table()},
        quiet);
  return end.failed == 0 && !is_much_left_out(inputs->left_out()) ? Done : SomeFailed;
}

}  // namespace

int run(const ClumpArguments& arguments) {
  const CommonArguments& common = arguments.common;
  checked([&] {
    check_clump_options(arguments.options);
    check_frame_options(arguments.frame);
    require_in_range(arguments.density, clump_density_option);
  });
  if (is_sample(arguments.inputs)) return run_sample(arguments);
  const std::string& scan = arguments.inputs.front();
  checked([&] {
    check_mesh_format(scan, MeshUse::Read);
    std::vector<NamedFile> outputs = named_reports(common.reports);
    for (const std::string& output : arguments.outputs) {
      check_clump_path(output);
      for (const std::string& file : files_of_clump(output)) {
        if (file.rfind(output + "/", 0) != 0) outputs.push_back({"the clump", file});
      }
    }
    check_output_paths({{"the scan", scan}}, outputs, common.overwrite);
    for (const std::string& report : common.reports) check_clump_report(report);
  });
  Work work(common);
  MeshFile file = read_mesh_file(scan, work.execution().part(0.0, reading_share));
  ClumpResult clump = make_clump(std::move(file.mesh), arguments.options,
                                 work.execution().part(reading_share, 1.0));
  clump.warnings.insert(clump.warnings.begin(), file.warnings.begin(), file.warnings.end());
  for (const std::string& output : arguments.outputs) {
    work.write(output, [&](const std::string& path, const Execution&) {
      write_clump(path, clump, arguments.frame, arguments.density);
    });
  }
  for (const std::string& report : common.reports) {
    work.write(report, [&](const std::string& path, const Execution& execution) {
      write_report(path, clump, origin_of(scan), execution);
    });
  }
  work.print(clump.warnings, clump_lines(clump));
  return Done;
}

}  // namespace wscvt::program
