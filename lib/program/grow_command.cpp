// SPDX-License-Identifier: GPL-3.0-or-later
#include "grow_command.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "command.h"
#include "common_arguments.h"
#include "exit_code.h"
#include "job_on_terminal.h"
#include "output_paths.h"
#include "shape_files.h"
#include "signals.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/base/output_file.h"

namespace wscvt::program {

CLI::App& add_command(CLI::App& program, GrowArguments& arguments) {
  CLI::App& app = add_command(
      program, {"grow",
                "Make virtual grains with the statistics of a sample",
                {"scans -n 10000 -o grown", "coefficients -n 500 -o grown --nodes 300 --format stl",
                 "scans -n 2000 -o grown --sizes sieve.csv --donors 2"},
                "OUT gets a mesh per grain, grown.csv and a script for Yade. The same sample, "
                "options and\nversion give the same bytes on any number of threads. Each grain "
                "is in its principal\nframe about the origin.",
                false,
                true});
  app.add_option(
         "sample", arguments.inputs,
         "Real grains: closed meshes or SH coefficients (.dat, .sh, .json); files, folders, "
         "patterns in quotes, or @FILE with one of these per line")
      ->type_name("SAMPLE")
      ->required();
  add_folder_argument(app, arguments.job.folder);
  add_number(app, "-n,--grains", arguments.job.grains, grown_count_option);
  add_number(app, "--nodes", arguments.job.nodes, grown_nodes_option);
  add_format_argument(app, arguments.job.format);
  app.add_flag("--coefficients", arguments.job.coefficients,
               "Write SH coefficients (.json) instead of meshes");
  add_file_argument(app, "--sizes", arguments.sizes,
                    "Size curve, a CSV file of two columns: equivalent diameter, % finer by mass. "
                    "Default: the sizes of the sample");
  add_number(app, "--donors", arguments.job.options.donors, donors_option);
  add_number(app, "--degree", arguments.job.degree, sample_degree_option);
  add_number(app, "--seed", arguments.job.options.seed, sample_seed_option);
  add_threads_argument(app, arguments.threads);
  add_quiet_argument(app, arguments.quiet);
  return app;
}

int run(const GrowArguments& arguments) {
  GrowJob job = arguments.job;
  checked([&] { check_job(job); });
  if (!arguments.quiet) check_writable("/dev/stdout");
  const std::vector<std::string> files = checked([&] { return shape_files(arguments.inputs); });
  if (!arguments.sizes.empty()) {
    job.sizes = checked([&] { return read_given_sizes(arguments.sizes); });
  }
  const MadeFolder folder(job.folder);
  check_writable((std::filesystem::path(job.folder) / "grown.csv").string());

  const auto grids = std::make_unique<const SampleGrids>(job.degree);
  RealGrains real = read_shapes(files, *grids, arguments.threads, arguments.quiet);
  const std::size_t left_out = real.left_out;
  GrownSample grown;
  on_terminal(arguments.threads, arguments.quiet, [&](const JobHost& host) {
    grown = grow_grains(job, std::move(real), *grids, host);
    return grown.end;
  });
  if (grown.end.was_cancelled()) return 128 + noted_signal();
  print(grown.lines, arguments.quiet);
  return left_out == 0 ? Done : SomeFailed;
}

}  // namespace wscvt::program
