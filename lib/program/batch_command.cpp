// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_command.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

#include "batch_grains.h"
#include "command.h"
#include "common_arguments.h"
#include "exit_code.h"
#include "grain_run.h"
#include "remesh_arguments.h"
#include "signals.h"
#include "volume_arguments.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/base/error.h"
#include "wscvt/base/file_name.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"
#include "wscvt/report/sample_summary.h"
#include "wscvt/report/sample_table.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt::program {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Where a batch puts what it makes.
class OutputFolder {
 public:
  OutputFolder(const BatchArguments& arguments)
      : folder_(arguments.folder), ending_("." + arguments.format) {
    if (arguments.shard.count > 1) {
      part_ = "-" + std::to_string(arguments.shard.index) + "-of-" +
              std::to_string(arguments.shard.count);
    }
  }

  std::string mesh(const std::string& grain) const {
    fs::path name = fs::path(grain).filename();
    if (ending_of(grain) == ".gz") name = name.stem();
    return (folder_ / name.stem()).string() + ending_;
  }
  std::string table() const { return file("grains", ".csv"); }
  /// The same for every part: what a volume holds.
  std::string labels() const { return (folder_ / "labels.csv").string(); }
  std::string call() const { return file("call", ".json"); }
  std::string summary(const std::string& ending) const { return file("summary", ending); }

 private:
  std::string file(const std::string& name, const std::string& ending) const {
    return (folder_ / (name + part_ + ending)).string();
  }

  fs::path folder_;
  std::string ending_;
  std::string part_;
};

/// Refuses grains whose meshes would take each other's place, or a scan's.
void check_meshes(const std::vector<std::string>& grains, const OutputFolder& folder) {
  std::map<std::string, const std::string*> made;
  for (const std::string& grain : grains) {
    const auto [other, is_new] = made.emplace(folder.mesh(grain), &grain);
    if (!is_new) {
      throw Error(ErrorCode::InvalidInput, "\"" + *other->second + "\" and \"" + grain +
                                               "\" would both be remeshed to \"" + other->first +
                                               "\"; give them in two batches or rename one.");
    }
    if (same_file(other->first, grain)) {
      throw Error(ErrorCode::InvalidInput, "The remesh of \"" + grain +
                                               "\" would take its place; give another folder with "
                                               "-o, or another --format.");
    }
  }
}

/// What a batch that is started again has to have been called with. Not the number of threads.
std::string call_text(const BatchArguments& arguments) {
  return json_document({{"format", "wscvt-batch"},
                        {"made_by", made_by()},
                        {"meshes", arguments.format},
                        {"seconds", arguments.seconds},
                        {"volume", json_of(arguments.volume)},
                        {"options", wscvt::json_of(arguments.options)}});
}

void check_call(const std::string& path, const std::string& call, bool is_begun) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno != ENOENT && errno != ENOTDIR) refuse_to_read(path);
  const std::string before((std::istreambuf_iterator<char>(file)), {});
  if (before == call) return;
  if (is_begun) {
    throw Error(ErrorCode::InvalidInput,
                "A batch of other options or another version stands in that folder: see \"" + path +
                    "\"; call it as that says, or give another folder with -o.");
  }
  write_file(path, call);
}

/// The row of a grain, whose mesh is then written. Throws as row_or_failure.
GrainRow remeshed_row(const BatchArguments& arguments, const OutputFolder& folder,
                      BatchGrains& grains, std::size_t k, const Execution& execution) {
  const std::string& grain = grains.names()[k];
  const Clock::time_point start = Clock::now();
  const auto seconds = [&]() -> Seconds {
    if (!arguments.seconds) return {};
    return seconds_since(start);
  };
  const auto make = [&]() -> GrainRow {
    GrainScan scan = grains.read(k, execution);
    RemeshOptions options = arguments.options;
    options.measures.written = [path = folder.mesh(grain)](const RemeshResult& made) {
      return as_written(made.mesh, path);
    };
    RemeshResult result = remesh(std::move(scan.mesh), options, execution);
    result.warnings.insert(result.warnings.begin(), scan.warnings.begin(), scan.warnings.end());
    write_mesh(result.mesh, folder.mesh(grain));
    return {sample_row(grain, result, seconds()), ""};
  };
  return row_or_failure(make, [&](const std::string& error) -> GrainRow {
    return {failed_row(grain, error, seconds()), error};
  });
}

/// Half-written files that a killed batch left beside those it wrote.
void remove_parts(const std::vector<std::string>& grains, std::size_t first,
                  const OutputFolder& folder) {
  for (std::size_t k = first; k < grains.size(); ++k) remove_partial_file(folder.mesh(grains[k]));
  for (const std::string& file :
       {folder.call(), folder.summary(".json"), folder.summary(".html")}) {
    remove_partial_file(file);
  }
}

}  // namespace

BatchArguments::BatchArguments() { options.measures.suggestions = false; }

void add_sample_arguments(CLI::App& app, BatchArguments& arguments) {
  add_typed(app, "--shard",
            [&arguments](std::string_view text) { arguments.shard = shard_of(text); })
      ->description("Only the I-th of N parts of the grains, by their names")
      ->type_name("I/N");
  add_format_argument(app, arguments.format);
  app.add_flag("--seconds", arguments.seconds,
               "A column of the table for how long each grain took; it differs from run to run");
  add_remesh_arguments(app, arguments.options);
}

CLI::App& add_command(CLI::App& program, BatchArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"batch",
       "Remesh the grains of a sample, with a table and a summary",
       {"scans -o out -n 500 --method as-published",
        "'scans/*.stl' @more.txt -o other --format stl", "scans -o out --shard 1/2"},
       "OUT gets a mesh a grain, grains.csv, summary.html and summary.json. A batch that was "
       "killed "
       "and is\nstarted again goes on where it was. A part gets a table of its own: see wscvt "
       "collect.",
       true,
       true});
  app.add_option(
         "inputs", arguments.inputs,
         "Meshes, volumes of labels, folders, patterns in quotes, or @FILE with one of these a "
         "line")
      ->type_name("INPUT")
      ->required();
  app.add_option("-o,--output", arguments.folder, "Folder for all that is made")
      ->type_name("OUT")
      ->required();
  add_sample_arguments(app, arguments);
  add_volume_arguments(app, arguments.volume, finer_settings);
  add_threads_argument(app, arguments.threads);
  app.add_flag("-q,--quiet", arguments.quiet,
               "No summary on the standard output, no progress; failures stay");
  return app;
}

int run(const BatchArguments& arguments) {
  checked([&] {
    check_options(arguments.options);
    check_format(arguments.format);
    check_volume_options(arguments.volume);
  });
  if (!arguments.quiet) check_writable("/dev/stdout");
  const std::vector<std::string> files = checked([&] { return grain_files(arguments.inputs); });
  checked([&] {
    for (const std::string& file : files) {
      if (!is_volume(file)) check_mesh_format(file, MeshUse::Read);
    }
  });
  BatchGrains inputs(files, arguments.volume, arguments.shard, arguments.quiet);
  const std::vector<std::string>& grains = inputs.names();
  const OutputFolder folder(arguments);
  checked([&] { check_meshes(grains, folder); });
  std::error_code error;
  fs::create_directories(arguments.folder, error);
  const std::string header = sample_header(arguments.seconds);
  checked(
      [&] { check_call(folder.call(), call_text(arguments), fs::exists(folder.table(), error)); });
  SampleTable table = checked([&] { return SampleTable(folder.table(), header, grains); });
  const std::size_t first = table.rows();
  remove_parts(grains, first, folder);

  const std::string labels = inputs.label_table(
      [&](const std::string& grain) { return fs::path(folder.mesh(grain)).filename().string(); });
  if (!labels.empty()) write_file(folder.labels(), labels);
  inputs.begin(first);

  GrainRun all;
  all.first = first;
  all.failed = table.failed_rows();
  all.count = grains.size();
  all.threads = arguments.threads;
  all.quiet = arguments.quiet;
  all.when_stopped = "The same call goes on from there.";
  all.name = [&](std::size_t k) { return grains[k]; };
  all.work = [&](std::size_t k, const Execution& execution) {
    return remeshed_row(arguments, folder, inputs, k, execution);
  };
  all.take = [&](std::size_t, const GrainRow& row) { table.append(row.record); };
  const GrainRunEnd end = run_grains(all);
  if (end.was_cancelled) {
    return 128 + noted_signal();
  }
  if (arguments.shard.count == 1) {
    const SampleSummary summary = summarise_table(folder.table());
    for (const char* ending : {".json", ".html"}) write_summary(folder.summary(ending), summary);
    print(summary_lines(summary), arguments.quiet);
  }
  return end.failed == 0 && !inputs.is_much_left_out() ? Done : SomeFailed;
}

}  // namespace wscvt::program
