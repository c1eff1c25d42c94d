// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/grain_inputs.h"
#include "program/arguments/simulation_arguments.h"
#include "program/arguments/volume_arguments.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/terminal.h"
#include "program/terminal/work.h"
#include "toolbox/job/remesh_job.h"
#include "toolbox/volume/open_volume.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"

namespace wscvt::program {

namespace {

/// `wscvt batch`: remeshes the grains of a sample, one grain per thread, and writes a table and a
/// summary.
struct BatchArguments {
  ScanInputs sample;
  std::string folder;  ///< of the output
  int threads = 0;     ///< 0: all
  bool quiet = false;
  RemeshJob job;
};

/// Reads "500", or "100,300,1000" into levels. Returns the largest number for the options.
std::string largest_level(const std::string& text, std::vector<int>& levels) {
  levels.clear();
  if (text.find(',') == std::string::npos) return text;
  std::istringstream list(text);
  for (std::string one; std::getline(list, one, ',');) {
    levels.push_back(from_typed(one, node_count_option));
  }
  std::sort(levels.begin(), levels.end());
  return std::to_string(levels.back());
}

CLI::App& add_arguments(CLI::App& program, BatchArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"batch",
       "Remesh the grains of a sample and write a table and a summary",
       {"scans -o out -n 500 --method as-published",
        "'scans/*.stl' @more.txt -o other --format stl", "scans -o out --shard 1/2"},
       "OUT gets a mesh per grain, grains.csv, shape.csv, summary.html and summary.json. After an "
       "interruption, the same call continues the batch.",
       true,
       true});
  app.add_option("inputs", arguments.sample.inputs,
                 "Meshes, volumes of labels, folders, patterns in quotes, or @FILE with one of "
                 "these per line")
      ->type_name("INPUT")
      ->required();
  add_folder_argument(app, arguments.folder);
  add_shard_argument(app, arguments.sample.shard);
  add_format_argument(app, arguments.job.format);
  add_choice(app, arguments.job.shapes.described);
  add_remesh_arguments(app, arguments.job.remesh);
  add_simulation_arguments(app, arguments.job);
  arguments.sample.format = app.get_option("--format")->group(finer_settings);
  add_engine_arguments(app, arguments.sample, "level sets", EngineShapes::LevelSets);
  CLI::Option* nodes = app.get_option("--" + std::string(node_count_option.key));
  nodes->description(nodes->get_description() + ". Several, such as 100,300, get one folder each");
  nodes->transform([&arguments](const std::string& text) {
    try {
      return largest_level(text, arguments.job.levels);
    } catch (const Error& error) {
      throw CLI::ValidationError("--" + std::string(node_count_option.key), error.what());
    }
  });
  add_volume_arguments(app, arguments.job.volume, finer_settings);
  CLI::Option* parts = app.get_option("--" + std::string(parts_option.key));
  parts->description(parts->get_description() + ". Also make each body of a mesh a grain");
  add_threads_argument(app, arguments.threads);
  add_quiet_argument(app, arguments.quiet);
  return app;
}

/// Adds the files that an engine needs.
void add_engine_files(const ScanInputs& sample, RemeshJob& job) {
  check_engine_inputs(sample, EngineShapes::LevelSets, job.format, job.simulation.frame);
  if (sample.engine.empty()) return;
  if (!job.levels.empty()) refuse("--engine needs a single number of nodes. Give one.");
  const auto add = [](std::vector<std::string>& endings, const char* ending) {
    if (std::find(endings.begin(), endings.end(), ending) == endings.end()) {
      endings.emplace_back(ending);
    }
  };
  add(job.node_tables, "csv");
  add(job.grids, "npy");
}

int run(const BatchArguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  const ScanInputs& sample = arguments.sample;
  RemeshJob options = arguments.job;
  const FrameOptions& frame = options.simulation.frame;
  checked([&] {
    add_engine_files(sample, options);
    check_job(options);
    check_volume_options(options.volume);
    check_engine_folder(sample, arguments.folder, frame);
  });
  if (!arguments.quiet) check_writable("/dev/stdout");
  const std::vector<std::string> files = checked([&] { return input_files(sample.inputs); });
  const std::unique_ptr<GrainSource> inputs =
      open_inputs(files, options.volume, sample.shard, arguments.quiet, use_parts);
  options.shapes.contacts = options.shapes.described == Described::Contacts;
  options.shapes.resolution =
      describes_scan(options.shapes.described) &&
      (options.volume.choice.voxel_size || std::any_of(files.begin(), files.end(), is_volume));
  GrainJob job = make_job(options, arguments.folder, sample.shard);
  job.long_names = inputs->volumes() > 1;
  const JobEnd end = run_job(job, *inputs, arguments.threads, arguments.quiet);
  if (end.was_cancelled()) return 128 + noted_signal();
  std::vector<std::string> lines = write_summaries(job, Execution(arguments.threads));
  for (std::string& line :
       write_engine_files(sample, job, *inputs, EngineShapes::LevelSets, frame, engine_density)) {
    lines.push_back(std::move(line));
  }
  print_made(std::move(lines), arguments.folder, begin, arguments.quiet);
  return end.failed == 0 && !is_much_left_out(inputs->left_out()) ? Done : SomeFailed;
}

}  // namespace

Command batch_command(CLI::App& program) { return make_command<BatchArguments>(program); }

}  // namespace wscvt::program
