// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/arguments/grain_inputs.h"

#include <chrono>
#include <filesystem>
#include <utility>

#include "program/arguments/common_arguments.h"
#include "program/arguments/volume_arguments.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/terminal/terminal.h"
#include "program/terminal/work.h"
#include "toolbox/job/extract_job.h"
#include "toolbox/job/label_source.h"
#include "toolbox/sample/given_sizes.h"
#include "toolbox/volume/open_volume.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/option.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::program {

namespace {

void print_bodies(const std::string& path, const MeshBodies& bodies, bool quiet) {
  if (bodies.list.empty()) return;
  print({path + ": " + std::to_string(bodies.list.size()) + " bodies"}, quiet);
  print(bodies.warnings, quiet);
  for (std::size_t k = 0; k < bodies.list.size(); ++k) {
    const std::string& name = bodies.list[k].name;
    if (!name.empty()) print({"  " + std::to_string(k + 1) + ": " + name}, quiet);
  }
}

std::string sizes_in(const std::string& folder) {
  return (std::filesystem::path(folder) / "sizes.csv").string();
}

std::string weights_in(const std::string& folder) {
  return (std::filesystem::path(folder) / "templates.csv").string();
}

/// Whether the only input is a folder of templates.
bool are_templates(const ScanInputs& arguments) {
  return arguments.inputs.size() == 1 &&
         std::filesystem::exists(weights_in(arguments.inputs.front()));
}

/// Whether the size curve of templates is that of the packing. With a size all grains have it.
bool has_curve_of_templates(const ScanInputs& arguments, const FrameOptions& frame) {
  return are_templates(arguments) && arguments.sizes.empty() && !(frame.size > 0.0);
}

}  // namespace

bool ScanInputs::is_sample() const {
  return !engine.empty() || inputs.size() > 1 || names_files(inputs.front()) ||
         is_volume(inputs.front());
}

void add_scan_inputs(CLI::App& app, ScanInputs& arguments, const std::string& files,
                     std::string& format, EngineShapes shapes) {
  app.add_option("scans", arguments.inputs,
                 mesh_argument_text("Scan", MeshUse::Read) +
                     "; or several scans, folders, patterns in quotes, volumes of labels, or @FILE "
                     "with one of these per line")
      ->type_name("INPUT")
      ->required();
  arguments.format = app.add_option("--format", format,
                                    "Ending of the " + files +
                                        " of several scans, without the point. Default: " + format)
                         ->type_name("NAME")
                         ->group(finer_settings);
  add_shard_argument(app, arguments.shard);
  app.get_option("--shard")->group(finer_settings);
  add_engine_arguments(app, arguments, files, shapes);
}

void add_engine_arguments(CLI::App& app, ScanInputs& arguments, const std::string& files,
                          EngineShapes shapes) {
  app.add_option("--engine", arguments.engine,
                 "Make a folder of the " + files +
                     " that this engine packs: " + engine_names(shapes) +
                     ". Its run.py starts the engine; scene.json has what you may change")
      ->type_name("NAME");
  app.add_option(
         "--size-curve", arguments.sizes,
         "Size curve of the packing, a CSV file of two columns: equivalent diameter, in the "
         "unit of the output, % finer by mass. Default: the grains' own sizes")
      ->type_name("FILE")
      ->group(finer_settings);
}

void tell_density_of_packing(CLI::Option& density) {
  density.description(density.get_description() + ", with --engine " + typed_text(engine_density));
}

void check_engine_inputs(const ScanInputs& arguments, EngineShapes shapes, std::string& format,
                         FrameOptions& frame) {
  if (arguments.engine.empty()) {
    if (!arguments.sizes.empty()) refuse("--size-curve is for a packing. Give --engine too.");
    return;
  }
  const std::string own = engine_format(arguments.engine, shapes);
  if (arguments.format->count() > 0 && format != own) {
    refuse("The engine's files have their own format. Leave out --format.");
  }
  format = own;
  if (frame.frame == Frame::Centred) {
    refuse("The engine's files are in the principal frame. Leave out --frame.");
  }
  frame.frame = Frame::Principal;
  if (!arguments.sizes.empty()) read_given_sizes(arguments.sizes);
}

std::vector<std::string> write_engine_files(const ScanInputs& arguments, const GrainJob& job,
                                            const GrainSource& grains, EngineShapes shapes,
                                            const FrameOptions& frame, double density) {
  if (arguments.engine.empty() || arguments.shard.count > 1) return {};
  const JobFolder folder = folders_of(job).front();
  std::vector<EngineGrain> list;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    list.push_back({csv_field(grains.name(k)), folder.name_of(grains.name(k))});
  }
  const std::string& in = arguments.inputs.front();
  // run.py reads only commas, decimal points and one heading.
  const auto write_sizes = [&](const std::string& curve, double scale) {
    write_file(sizes_in(folder.path()), read_given_sizes(curve).table(scale));
  };
  if (are_templates(arguments)) {
    write_file(weights_in(folder.path()), file_content(weights_in(in)));
  }
  if (has_curve_of_templates(arguments, frame)) write_sizes(sizes_in(in), frame.scale);
  if (!arguments.sizes.empty()) write_sizes(arguments.sizes, 1.0);
  const bool is_given = arguments.density != nullptr && arguments.density->count() > 0;
  const std::string start = write_engine_folder(folder.path(), arguments.engine, shapes, list,
                                                frame, is_given ? density : engine_density);
  return {"Pack them: cd " + folder.path() + " && " + start};
}

void check_engine_folder(const ScanInputs& arguments, const std::string& folder,
                         const FrameOptions& frame) {
  if (arguments.engine.empty()) return;
  require_own_script(folder);
  require_own_table(folder, "sizes.csv", GivenSizes::heading());
  if (!are_templates(arguments) && std::filesystem::exists(weights_in(folder))) {
    refuse("The folder \"" + folder +
           "\" has weights of templates, templates.csv, which its packing would get. Remove them, "
           "or give another folder with " +
           mention("output") + ".");
  }
  if (!same_file(sizes_in(arguments.inputs.front()), sizes_in(folder))) {
    if (!arguments.sizes.empty() || has_curve_of_templates(arguments, frame) ||
        !std::filesystem::exists(sizes_in(folder))) {
      return;
    }
    refuse(
        "The folder \"" + folder +
        "\" has a size curve, sizes.csv, which its packing would get. Give it, or another, with " +
        mention("size-curve") + ", or remove it for the grains' own sizes.");
  }
  if (frame.scale == 1.0 && !(frame.size > 0.0)) return;
  refuse("The folder \"" + folder +
         "\" has the grains, whose size curve would be scaled too. Give another folder with " +
         mention("output") + ".");
}

void check_one_scan(const ScanInputs& arguments) {
  if (arguments.format->count() > 0) {
    refuse(
        "One scan is given, and --format is for several. Leave it out: the ending of --output "
        "selects the format.");
  }
  if (arguments.shard.count > 1) {
    refuse("One scan is given, and --shard is for several. Leave it out.");
  }
}

void check_sample_outputs(const std::vector<std::string>& outputs,
                          const std::vector<std::string>& reports, const std::string& files,
                          const std::function<bool(const std::string&)>& is_file) {
  if (outputs.size() != 1 || is_file(outputs.front())) {
    refuse("Several scans are given. Give one folder with -o, and --format for the " + files + ".");
  }
  if (!reports.empty()) {
    refuse(
        "Several scans are given. Their table is grains.csv in the folder of -o. Leave out "
        "--report.");
  }
}

int run_sample(const ScanInputs& arguments, GrainJob job, EngineShapes shapes,
               const FrameOptions& frame, double density, int threads, bool quiet) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<std::string> files = checked([&] {
    check_engine_folder(arguments, job.folder, frame);
    return input_files(arguments.inputs);
  });
  const std::unique_ptr<GrainSource> inputs = open_inputs(
      files, {}, arguments.shard, quiet,
      "call wscvt extract VOLUME OUT --parts first, and give OUT instead of the volume");
  job.long_names = inputs->volumes() > 1;
  const JobEnd end = run_job(job, *inputs, threads, quiet);
  if (end.was_cancelled()) return 128 + noted_signal();
  print({end_line(job, end)}, quiet);  // also if the engine's files cannot be written
  print_made(write_engine_files(arguments, job, *inputs, shapes, frame, density), job.folder, begin,
             quiet);
  return end.failed == 0 && !is_much_left_out(inputs->left_out()) ? Done : SomeFailed;
}

std::vector<std::string> input_files(const std::vector<std::string>& inputs) {
  std::vector<std::string> files = grain_files(inputs, is_volume);
  for (const std::string& file : files) {
    if (is_volume(file)) continue;
    refuse_spheres(file);
    check_mesh_format(file, MeshUse::Read);
  }
  return files;
}

std::unique_ptr<GrainSource> open_inputs(const std::vector<std::string>& files,
                                         const VolumeOptions& options, const Shard& shard,
                                         bool quiet, const std::string& parts_advice) {
  auto inputs = std::make_unique<JoinedGrains>(shard);
  for (const std::string& path : files) {
    if (is_volume(path)) {
      std::unique_ptr<LabelGrains> grains = open_grains(path, options, quiet);
      print_notes(*grains, parts_advice, quiet);
      auto labels = std::make_unique<LabelSource>(path, std::move(grains));
      const std::string census = labels->census([](const std::string&) { return MadeGrain(); });
      print({census_line(census_states(census), "labels")}, quiet);
      inputs->add(std::move(labels));
    } else if (options.parts) {
      std::unique_ptr<MeshGrains> bodies = with_progress(
          quiet, [&](const Execution& one) { return std::make_unique<MeshGrains>(path, one); });
      print_bodies(path, bodies->bodies(), quiet);
      inputs->add(std::move(bodies));
    } else {
      inputs->add(std::make_unique<MeshGrains>(path));
    }
  }
  return inputs;
}

}  // namespace wscvt::program
