// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_command.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>

#include "command.h"
#include "common_arguments.h"
#include "exit_code.h"
#include "grain_inputs.h"
#include "job_on_terminal.h"
#include "remesh_arguments.h"
#include "signals.h"
#include "toolbox/clump/first_contact.h"
#include "toolbox/report/sample_summary.h"
#include "toolbox/report/sample_table.h"
#include "volume_arguments.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/base/error.h"
#include "wscvt/base/file_name.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/carried_attributes.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"

namespace wscvt::program {

namespace {

/// Returns the options that must be equal when a batch is started again, so without the number of
/// threads.
std::string call_text(const BatchArguments& arguments) {
  return json_document({{"format", "wscvt-batch"},
                        {"made_by", made_by()},
                        {"meshes", arguments.format},
                        {"seconds", arguments.seconds},
                        {"levels", arguments.levels},
                        {"describe", key_of(arguments.shapes.described)},
                        {"contacts", arguments.shapes.contacts},
                        {"volume", json_of(arguments.volume)},
                        {"options", wscvt::json_of(arguments.options)}});
}

/// Returns the remesh of a grain, or one remesh per level.
std::vector<RemeshResult> remeshes_of(const BatchArguments& arguments, IndexedMesh scan,
                                      const RemeshOptions& options, const Execution& execution) {
  if (!arguments.levels.empty()) {
    return remesh_levels(std::move(scan), options, arguments.levels, execution);
  }
  std::vector<RemeshResult> results;
  results.push_back(remesh(std::move(scan), options, execution));
  return results;
}

/// Measures of a grain's scan, made with its first level.
struct MeasuredScan {
  std::optional<DetailedDescriptors> shape;
  std::optional<ScanContacts> contacts;
};

/// Returns the measures of a level. A failed measurement becomes a warning of the remesh, and its
/// message is written to `error`.
GrainShape measure_level(const ShapeMeasures& measures, RemeshResult& result, MeasuredScan& scan,
                         std::string& error, const Execution& execution) {
  const Described what = measures.described;
  const bool needs_scan = describes_scan(what) && !scan.shape;
  const Described now = needs_scan               ? what
                        : describes_remesh(what) ? Described::Remesh
                                                 : Described::None;
  GrainShape shape;
  try {
    shape = describe_result(result, now, execution);
    if (needs_scan) scan.shape = std::move(shape.scan);
    shape.scan = scan.shape;
    if (measures.contacts) {
      if (!scan.contacts) scan.contacts.emplace(result.repaired_scan, result.scan, execution);
      shape.contacts = scan.contacts->error_of(result.mesh, execution);
    }
  } catch (const Error& failure) {
    if (failure.code() == ErrorCode::Cancelled) throw;
    error = failure.what();
    result.warnings.push_back("The descriptors could not be measured: " + error);
  }
  return shape;
}

/// Remeshes a grain, writes its meshes and returns its records.
std::vector<std::string> make_grain(const BatchArguments& arguments, GrainAtWork& grain) {
  const Execution& execution = grain.execution;
  const std::string first = grain.folders.front().file_of(grain.name);
  RemeshOptions options = arguments.options;
  options.measures.repaired_scan =
      describes_scan(arguments.shapes.described) || arguments.shapes.contacts;
  options.measures.written = [&first](const RemeshResult& made) {
    return as_written(made.mesh, first);
  };
  const MeshAttributes& read_attributes = grain.scan.attributes;
  const bool carries = holds_attributes(first) && !read_attributes.empty();
  const IndexedMesh read = carries ? grain.scan.mesh : IndexedMesh();
  std::vector<RemeshResult> results =
      remeshes_of(arguments, std::move(grain.scan.mesh), options, execution);
  std::vector<std::string> records;
  MeasuredScan measured;
  for (std::size_t level = 0; level < results.size(); ++level) {
    RemeshResult& result = results[level];
    const JobFolder& folder = grain.folders[level];
    result.warnings.insert(result.warnings.begin(), grain.scan.warnings.begin(),
                           grain.scan.warnings.end());
    const bool describes = arguments.shapes.described != Described::None;
    std::string error;
    GrainShape shape;
    if (describes) shape = measure_level(arguments.shapes, result, measured, error, execution);
    const MeshAttributes attributes =
        carries ? carried_attributes(read, read_attributes, result.mesh, execution)
                : MeshAttributes();
    write_mesh(result.mesh, attributes, folder.file_of(grain.name));
    records.push_back(
        sample_row(grain.name, result, arguments.seconds ? Seconds(grain.seconds()) : Seconds()));
    if (!describes) continue;
    records.push_back(error.empty()
                          ? shape_row(grain.name, folder.name_of(grain.name), result, shape)
                          : failed_shape_row(grain.name, error, arguments.shapes));
  }
  return records;
}

GrainJob batch_job(const BatchArguments& arguments) {
  const bool describes = arguments.shapes.described != Described::None;
  GrainJob job;
  job.folder = arguments.folder;
  job.shard = arguments.shard;
  job.ending = arguments.format;
  for (const int nodes : arguments.levels) job.levels.push_back("n" + std::to_string(nodes));
  job.call = call_text(arguments);
  job.tables = {{"grains", sample_header(arguments.seconds)}};
  if (describes) job.tables.push_back({"shape", shape_header(arguments.shapes)});
  job.has_census = true;
  job.reads_pictures = holds_attributes("mesh." + arguments.format);
  job.make = [&arguments](GrainAtWork& grain) { return make_grain(arguments, grain); };
  job.failed = [&arguments, describes](const std::string& grain, const std::string& error,
                                       double seconds) {
    std::vector<std::string> records = {
        failed_row(grain, error, arguments.seconds ? Seconds(seconds) : Seconds())};
    if (describes) records.push_back(failed_shape_row(grain, error, arguments.shapes));
    return records;
  };
  return job;
}

void write_summaries(const JobFolder& folder, bool quiet) {
  const SampleSummary summary = summarise_table(folder.table());
  for (const char* ending : {".json", ".html"}) {
    write_summary(folder.file("summary", ending), summary);
  }
  print(summary_lines(summary), quiet);
}

/// Reads "500", or "100,300,1000" into levels. Returns the largest number for the options.
std::string largest_level(const std::string& text, std::vector<int>& levels) {
  levels.clear();
  if (text.find(',') == std::string::npos) return text;
  std::istringstream list(text);
  for (std::string one; std::getline(list, one, ',');) {
    levels.push_back(from_typed(one, node_count_option));
  }
  std::sort(levels.begin(), levels.end());
  if (std::adjacent_find(levels.begin(), levels.end()) != levels.end()) {
    refuse("The list \"" + text + "\" contains a number of nodes twice. Give it once.");
  }
  return std::to_string(levels.back());
}

}  // namespace

void add_sample_arguments(CLI::App& app, BatchArguments& arguments) {
  add_typed(app, "--shard",
            [&arguments](std::string_view text) { arguments.shard = shard_of(text); })
      ->description("Remesh only part I of N of the grains, selected by their names")
      ->type_name("I/N");
  add_format_argument(app, arguments.format);
  app.add_flag("--seconds", arguments.seconds,
               "Add the run time of each grain to the table; it differs between runs");
  add_choice(app, "--describe", arguments.shapes.described);
  app.add_flag("--contacts", arguments.shapes.contacts,
               "Add the error of first contact to shape.csv: two remeshes against two scans, over "
               "random pairs of poses");
  add_remesh_arguments(app, arguments.options);
  CLI::Option* nodes = app.get_option("--" + std::string(node_count_option.key));
  nodes->description(nodes->get_description() +
                     ". Several numbers, such as 100,300,1000, get one folder each");
  nodes->transform([&arguments](const std::string& text) {
    try {
      return largest_level(text, arguments.levels);
    } catch (const Error& error) {
      throw CLI::ValidationError("--" + std::string(node_count_option.key), error.what());
    }
  });
}

CLI::App& add_command(CLI::App& program, BatchArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"batch",
       "Remesh the grains of a sample and write a table and a summary",
       {"scans -o out -n 500 --method as-published",
        "'scans/*.stl' @more.txt -o other --format stl", "scans -o out --shard 1/2"},
       "OUT gets a mesh per grain, grains.csv, shape.csv, summary.html and summary.json. After an\n"
       "interruption, the same call continues the batch. With --shard each part has its own\n"
       "tables; join them with wscvt collect.",
       true,
       true});
  app.add_option("inputs", arguments.inputs,
                 "Meshes, volumes of labels, folders, patterns in quotes, or @FILE with one of "
                 "these per line")
      ->type_name("INPUT")
      ->required();
  app.add_option("-o,--output", arguments.folder, "Output folder")->type_name("OUT")->required();
  add_sample_arguments(app, arguments);
  add_volume_arguments(app, arguments.volume, finer_settings);
  add_threads_argument(app, arguments.threads);
  app.add_flag("-q,--quiet", arguments.quiet, "Print only warnings and failures");
  return app;
}

int run(const BatchArguments& arguments) {
  checked([&] {
    check_options(arguments.options);
    if (!arguments.levels.empty() && arguments.options.target.percent > 0.0) {
      refuse("--max-error needs a single number of nodes. Leave it out.");
    }
    if (arguments.shapes.contacts && arguments.shapes.described == Described::None) {
      refuse(
          "--contacts adds columns to shape.csv, but --describe none does not write this file. Use "
          "--describe remesh, or leave out --contacts.");
    }
    check_format(arguments.format);
    check_volume_options(arguments.volume);
  });
  if (!arguments.quiet) check_writable("/dev/stdout");
  const std::vector<std::string> files = checked([&] { return input_files(arguments.inputs); });
  const std::unique_ptr<GrainSource> inputs =
      open_inputs(files, arguments.volume, arguments.shard, arguments.quiet);
  const GrainJob job = batch_job(arguments);
  const JobEnd end = run_job(job, *inputs, arguments.threads, arguments.quiet);
  if (end.was_cancelled()) return 128 + noted_signal();
  if (arguments.shard.count == 1) {
    for (const JobFolder& level : folders_of(job)) write_summaries(level, arguments.quiet);
  }
  return end.failed == 0 && !is_much_left_out(inputs->left_out()) ? Done : SomeFailed;
}

}  // namespace wscvt::program
