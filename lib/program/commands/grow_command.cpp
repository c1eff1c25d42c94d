// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/output_paths.h"
#include "program/arguments/shape_files.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/terminal.h"
#include "program/terminal/work.h"
#include "toolbox/job/grow_job.h"
#include "toolbox/job/template_job.h"
#include "wscvt/base/output_file.h"

namespace wscvt::program {

namespace {

/// `wscvt grow`: makes virtual grains with the statistics of a sample, or chooses templates.
struct GrowArguments {
  std::vector<std::string> inputs;
  std::string sizes;  ///< file of a size curve; empty: sizes of the sample
  /// Chooses real grains instead, by these descriptors, or "true" for the job's. Empty: grows.
  std::string templates;
  GrowJob job;
  TemplateJob choice;        ///< of templates, with the job's folder, shard, format and nodes
  std::optional<int> count;  ///< of grains; empty: the default of the job
  int threads = 0;
  bool quiet = false;
};

GrowJob checked_job(const GrowArguments& arguments) {
  GrowJob job = arguments.job;
  if (arguments.count) job.grains = *arguments.count;
  check_job(job);
  if (!arguments.sizes.empty()) job.sizes = read_given_sizes(arguments.sizes);
  return job;
}

TemplateJob checked_choice(const GrowArguments& arguments) {
  TemplateJob job = arguments.choice;
  job.folder = arguments.job.folder;
  job.shard = arguments.job.shard;
  job.format = arguments.job.format;
  job.nodes = arguments.job.nodes;
  job.options.seed = arguments.job.options.seed;
  if (arguments.templates != "true") {
    job.descriptors.clear();
    std::istringstream names(arguments.templates);
    for (std::string name; std::getline(names, name, ',');) job.descriptors.push_back(name);
  }
  if (arguments.count) job.options.count = *arguments.count;
  require_in_range(job.options.count, template_count_option);
  check_format(job.format);
  if (!arguments.sizes.empty()) {
    refuse("Templates have the sizes of the sample. Leave out " + mention("size-curve") + ".");
  }
  return job;
}

int choose_templates_of(const GrowArguments& arguments,
                        std::chrono::steady_clock::time_point begin) {
  const TemplateJob job = checked([&] { return checked_choice(arguments); });
  const MadeFolder folder(job.folder);
  const DescribedSample sample =
      described_sample(arguments.inputs, job.descriptors, arguments.threads, arguments.quiet);
  checked([&] { require_scans_kept(job, sample.files); });
  MadeSample made;
  on_terminal(arguments.threads, arguments.quiet, [&](const JobHost& host) {
    made = make_templates(job, sample, grain_mesh, host);
    return made.end;
  });
  if (made.end.was_cancelled()) return 128 + noted_signal();
  print_made(std::move(made.lines), job.folder, begin, arguments.quiet);
  return sample.left_out == 0 ? Done : SomeFailed;
}

CLI::App& add_arguments(CLI::App& program, GrowArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"grow",
       "Make virtual grains like those of a sample, or choose templates of it",
       {"scans -k 10000 -o grown", "coefficients -k 500 -o grown -n 300 --format stl",
        "scans -k 2000 -o grown --size-curve sieve.csv", "scans --templates -k 20 -o chosen",
        "shape.csv --templates=convexity,roundness_wadell -k 50 -o chosen"},
       "OUT gets a mesh per grain and grown.csv; of templates, meshes of the volume of a sphere of "
       "diameter 1, templates.csv (weights and sizes), sizes.csv and mercury_psd.csv (the size "
       "curve) and distances.csv. Meshes are in the principal frame. wscvt clump OUT --engine NAME "
       "packs them.",
       false,
       true});
  app.add_option(
         "sample", arguments.inputs,
         "Real grains: closed meshes or SH coefficients (.dat, .sh, .json); files, folders, "
         "patterns in quotes, or @FILE with one of these per line. For templates also the "
         "folder of a batch, or a table of shapes (.csv) with the columns \"volume\" and "
         "\"file\"")
      ->type_name("SAMPLE")
      ->required();
  add_folder_argument(app, arguments.job.folder);
  app.add_flag(
         "--templates", arguments.templates,
         "Choose real grains with weights that represent the sample by these descriptors, with "
         "commas between: names as in the files of wscvt describe. Default: "
         "sphericity_wadell, zingg_elongation_inertia, zingg_flatness_inertia and convexity")
      ->option_text("[=NAMES]");
  add_typed(app, "-k,--count",
            [&arguments](std::string_view text) {
              arguments.count = from_typed(text, grown_count_option);
            })
      ->description(
          "Number of grains, 1 to 10000000; of templates at most 1000. Default: 1000, of "
          "templates 20")
      ->type_name("N");
  add_number(app, "-n,--nodes", arguments.job.nodes, grown_nodes_option);
  app.add_option("--format", arguments.job.format,
                 "Ending of the meshes: " + mesh_extensions(MeshUse::Write) +
                     ", without the point; or json: SH coefficients, no meshes. Default: ply")
      ->type_name("NAME");
  add_file_argument(app, "--size-curve", arguments.sizes,
                    "Size curve, a CSV file of two columns: equivalent diameter, % finer by mass. "
                    "Default: the sizes of the sample");
  add_number(app, "-d,--degree", arguments.job.degree, sample_degree_option);
  add_number(app, "--seed", arguments.job.options.seed, sample_seed_option);
  add_shard_argument(app, arguments.job.shard);
  add_threads_argument(app, arguments.threads);
  add_quiet_argument(app, arguments.quiet);
  return app;
}

int run(const GrowArguments& arguments) {
  const auto begin = std::chrono::steady_clock::now();
  if (!arguments.quiet) check_writable("/dev/stdout");
  if (!arguments.templates.empty()) return choose_templates_of(arguments, begin);
  const GrowJob job = checked([&] { return checked_job(arguments); });
  const std::vector<std::string> files = checked([&] {
    std::vector<std::string> real = shape_files(arguments.inputs);
    require_scans_kept(job, real);
    return real;
  });
  const MadeFolder folder(job.folder);
  const auto grids = std::make_unique<const SampleGrids>(job.degree);
  RealGrains real = read_shapes(files, *grids, arguments.threads, arguments.quiet);
  const std::size_t left_out = real.left_out;
  MadeSample grown;
  on_terminal(arguments.threads, arguments.quiet, [&](const JobHost& host) {
    grown = grow_grains(job, std::move(real), *grids, host);
    return grown.end;
  });
  if (grown.end.was_cancelled()) return 128 + noted_signal();
  print_made(std::move(grown.lines), job.folder, begin, arguments.quiet);
  return left_out == 0 ? Done : SomeFailed;
}

}  // namespace

Command grow_command(CLI::App& program) { return make_command<GrowArguments>(program); }

}  // namespace wscvt::program
