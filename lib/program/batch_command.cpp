// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_command.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <thread>

#include "command.h"
#include "common_arguments.h"
#include "exit_code.h"
#include "grain_queue.h"
#include "progress_line.h"
#include "remesh_arguments.h"
#include "signals.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"
#include "wscvt/report/report_file.h"
#include "wscvt/report/report_origin.h"
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
    return (folder_ / fs::path(grain).stem()).string() + ending_;
  }
  std::string table() const { return file("grains", ".csv"); }
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
  return "{\n\"format\": \"wscvt-batch\",\n\"made_by\": \"" + made_by() + "\",\n\"meshes\": \"" +
         arguments.format + "\",\n\"seconds\": " + (arguments.seconds ? "true" : "false") +
         ",\n\"options\": " + options_json(arguments.options) + "}\n";
}

void check_call(const std::string& path, const std::string& call, bool is_begun) {
  std::ifstream file(path, std::ios::binary);
  const std::string before((std::istreambuf_iterator<char>(file)), {});
  if (before == call) return;
  if (is_begun) {
    throw Error(ErrorCode::InvalidInput,
                "A batch of other options or another version stands in that folder: see \"" + path +
                    "\"; call it as that says, or give another folder with -o.");
  }
  write_file(path, call);
}

/// The row of a grain, whose mesh is then written. Throws Error(Cancelled) alone.
GrainRow remeshed_row(const BatchArguments& arguments, const OutputFolder& folder,
                      const std::string& grain, const Execution& execution) {
  const Clock::time_point start = Clock::now();
  const auto seconds = [&]() -> Seconds {
    if (!arguments.seconds) return {};
    return seconds_since(start);
  };
  const auto failure = [&](const std::string& error) -> GrainRow {
    return {failed_row(grain, error, seconds()), error};
  };
  try {
    const RemeshResult result = remesh(read_mesh(grain), arguments.options, execution);
    write_mesh(result.mesh, folder.mesh(grain));
    return {sample_row(grain, result, seconds()), ""};
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    return failure(error.what());
  } catch (const std::bad_alloc&) {
    return failure("There is not enough memory for this mesh; take fewer threads.");
  } catch (const std::exception& error) {
    return failure(error.what());
  }
}

/// "2 h 5 min", "3 min 20 s", "7 s".
std::string duration_text(double seconds) {
  const auto all = static_cast<long long>(seconds + 0.5);
  if (all >= 3600)
    return std::to_string(all / 3600) + " h " + std::to_string(all % 3600 / 60) + " min";
  if (all >= 60) return std::to_string(all / 60) + " min " + std::to_string(all % 60) + " s";
  return std::to_string(all) + " s";
}

/// What the line on the terminal says.
std::string progress_text(std::size_t done, std::size_t count, std::size_t failed, double rate) {
  std::string text = std::to_string(done) + " of " + std::to_string(count) + " grains";
  if (failed > 0) text += ", " + std::to_string(failed) + " failed";
  if (rate > 0.0) {
    text += ", " + format_number(rate, 3) + " a second, " +
            duration_text(static_cast<double>(count - done) / rate) + " left";
  }
  return text;
}

/// Half-written meshes that a killed batch left beside those it wrote.
void remove_parts(const std::vector<std::string>& grains, std::size_t first,
                  const OutputFolder& folder) {
  std::error_code ignored;
  for (std::size_t k = first; k < grains.size(); ++k) {
    fs::remove(folder.mesh(grains[k]) + ".part", ignored);
  }
}

int thread_count(int asked, std::size_t grains) {
  const int all = asked > 0 ? asked : static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1,
                  static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(all), grains)));
}

}  // namespace

BatchArguments::BatchArguments() { options.measures.advice = false; }

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
       true});
  app.add_option("inputs", arguments.inputs,
                 "Meshes, folders of them, patterns in quotes, or @FILE with one of these a line")
      ->type_name("INPUT")
      ->required();
  app.add_option("-o,--output", arguments.folder, "Folder for all that is made")
      ->type_name("OUT")
      ->required();
  add_typed(app, "--shard",
            [&arguments](std::string_view text) { arguments.shard = shard_of(text); })
      ->description("Only the I-th of N parts of the grains, by their names")
      ->type_name("I/N");
  app.add_option("--format", arguments.format,
                 "Ending of the meshes: ply, stl, obj or off. "
                 "Default: ply")
      ->type_name("NAME");
  app.add_flag("--seconds", arguments.seconds,
               "A column of the table for how long each grain took; it differs from run to run");
  add_remesh_arguments(app, arguments.options);
  add_threads_argument(app, arguments.threads);
  app.add_flag("-q,--quiet", arguments.quiet,
               "No summary on the standard output, no progress; failures stay");
  return app;
}

int run(const BatchArguments& arguments) {
  check_options(arguments.options);
  check_mesh_format("mesh." + arguments.format);
  const std::vector<std::string> grains = files_of(arguments.shard, grain_files(arguments.inputs));
  const OutputFolder folder(arguments);
  check_meshes(grains, folder);
  std::error_code error;
  fs::create_directories(arguments.folder, error);
  if (!arguments.quiet) check_writable("/dev/stdout");
  const std::string header = sample_header(arguments.seconds);
  check_call(folder.call(), call_text(arguments), fs::exists(folder.table(), error));
  SampleTable table(folder.table(), header, grains);
  const std::size_t first = table.rows();
  remove_parts(grains, first, folder);

  note_signals();
  ProgressLine line(!arguments.quiet);
  const Clock::time_point start = Clock::now();
  std::atomic<std::size_t> done{first};
  std::atomic<std::size_t> failed{table.failed_rows()};
  std::atomic<bool> stopped{false};
  const auto work = [&](std::size_t k) {
    return remeshed_row(arguments, folder, grains[k], Execution(1, [&](double, const std::string&) {
                          return !stopped && noted_signal() == 0;
                        }));
  };
  const auto take = [&](const GrainRow& row) {
    table.append(row.record);
    ++done;
    if (row.error.empty()) return;
    ++failed;
    line.clear();
    std::fprintf(stderr, "Failed: %s: %s\n", grains[done - 1].c_str(), row.error.c_str());
  };
  GrainQueue queue(first, grains.size(), work, take);
  try {
    queue.run(thread_count(arguments.threads, grains.size()), [&] {
      const std::size_t now = done;
      const double rate = static_cast<double>(now - first) / seconds_since(start);
      const double share = static_cast<double>(now) / static_cast<double>(grains.size());
      line.show(share, progress_text(now, grains.size(), failed, rate));
      stopped = noted_signal() != 0;
      return !stopped;
    });
  } catch (const Error& cancelled) {
    if (cancelled.code() != ErrorCode::Cancelled) throw;
  }
  line.clear();
  if (done < grains.size()) {
    std::fprintf(stderr, "Cancelled after %zu of %zu grains. The same call goes on from there.\n",
                 done.load(), grains.size());
    return 128 + noted_signal();
  }
  if (arguments.shard.count == 1) {
    const SampleSummary summary = summarise_table(folder.table());
    for (const char* ending : {".json", ".html"}) write_summary(folder.summary(ending), summary);
    print(summary_lines(summary), arguments.quiet);
  }
  return failed == 0 ? Done : SomeFailed;
}

}  // namespace wscvt::program
