// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/grain_inputs.h"
#include "program/arguments/output_paths.h"
#include "program/arguments/simulation_arguments.h"
#include "program/arguments/volume_arguments.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/terminal.h"
#include "program/terminal/work.h"
#include "toolbox/conforming/conforming_files.h"
#include "toolbox/conforming/conforming_grains.h"
#include "toolbox/job/extract_job.h"
#include "toolbox/job/job_folder.h"
#include "toolbox/job/label_source.h"
#include "toolbox/volume/open_volume.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::program {

namespace {

/// `wscvt extract`: makes a mesh of each label of a volume, or of each body of a mesh.
struct ExtractArguments {
  std::string input;  ///< a volume or a mesh
  std::string folder;
  std::string smallest;  ///< voxels, or % of the largest body; empty: the job's
  ExtractJob job;
  Shard shard;
  ConformingOptions walls;         ///< of conforming grains; its smoothing is the job's
  TetrahedraArguments tetrahedra;  ///< of conforming grains
  /// Options of conforming grains. Any of them asks for these, as wscvt fragment does.
  std::vector<const CLI::Option*> of_walls;
  int threads = 0;
  bool quiet = false;

  bool is_conforming() const {
    return std::any_of(of_walls.begin(), of_walls.end(),
                       [](const CLI::Option* option) { return option->count() > 0; });
  }
};

namespace fs = std::filesystem;

/// Remeshes all taken labels at once.
int run_conforming(const ExtractArguments& arguments, LabelGrains& grains) {
  const std::vector<Label> labels = taken_labels(grains);  // its refusal is a warning of the notes
  print_notes(grains, use_parts, arguments.quiet);
  Work work(arguments.threads, arguments.quiet);
  const MadeFolder folder(arguments.folder);
  const auto in_folder = [&](const std::string& name) {
    return (fs::path(arguments.folder) / name).string();
  };
  std::vector<std::string> files;
  for (const Label label : labels) {
    files.push_back(std::to_string(label) + "." + arguments.job.format);
  }
  checked([&] {
    require_no_job(arguments.folder);
    require_own_table(arguments.folder, "grains.csv", conforming_csv(ConformingGrains(), {}, {}));
    require_no_other_results(arguments.folder, "labels", {files.begin(), files.end()});
  });
  check_writable(in_folder("grains.csv"));
  const OlderFiles older(arguments.folder, {"labels.csv", "grains.csv"});
  ConformingOptions options = arguments.walls;
  options.smoothing = arguments.job.volume.smoothing;
  const ConformingGrains result =
      conform_labels(grains.voxels(), labels, options, work.execution());
  const std::vector<IndexedMesh> meshes = body_meshes(result, result.grains.size());
  for (std::size_t g = 0; g < labels.size(); ++g) {
    const std::string path = in_folder(files[g]);
    work.write(path, [&] { write_mesh(meshes[g], path); });
  }
  std::string rows = label_header();
  for (const LabelExtent& label : grains.labels()) {
    rows += label_row(arguments.input, grains, label, {});
  }
  work.write_text(in_folder("labels.csv"), [&] { return rows; });
  work.write_text(in_folder("walls.vtu"), [&] { return walls_vtu(result, labels); });
  work.write_text(in_folder("walls.msh"), [&] { return walls_msh(result, labels); });
  work.write_text(in_folder("walls.csv"), [&] { return walls_csv(result, labels); });
  work.write_text(in_folder("grains.csv"), [&] { return conforming_csv(result, labels, files); });
  std::vector<std::string> lines = conforming_lines(result);
  lines.insert(lines.begin(), census_line(census_states(rows), "labels"));
  for (std::string& line : older.remove_but(files, arguments.input))
    lines.push_back(std::move(line));
  const auto filled = write_all_tetrahedra(arguments.tetrahedra, work, [&] {
    std::vector<std::string> names;
    for (const Label label : labels) names.push_back(std::to_string(label));
    return tetrahedra_in(meshes, "grain", names, arguments.walls.edge_length, work.execution());
  });
  lines.insert(lines.end(), filled.begin(), filled.end());
  work.print(conforming_warnings(result, labels), std::move(lines), arguments.folder);
  return is_much_left_out(left_out(result)) ? SomeFailed : Done;
}

/// Returns the bodies of a mesh, with a progress line on a terminal unless quiet.
std::unique_ptr<BodyGrains> open_bodies(const ExtractArguments& arguments) {
  return with_progress(arguments.quiet, [&](const Execution& execution) {
    return std::make_unique<BodyGrains>(arguments.input, arguments.job.smallest_body, execution);
  });
}

/// Throws Error for what does not go with conforming grains.
void check_walls(const ExtractArguments& arguments, bool is_mesh) {
  std::string given;
  for (const CLI::Option* option : arguments.of_walls) {
    if (option->count() == 0) continue;
    given += (given.empty() ? "" : ", ") + option->get_name();
  }
  const std::string remeshes = given + " remeshes all grains of a volume of labels at once. ";
  if (is_mesh) {
    refuse(remeshes + "For the bodies of a mesh use wscvt batch MESH --parts -n N -o OUT.");
  }
  if (arguments.job.describe) refuse(remeshes + "Leave out --describe.");
  if (arguments.shard.count > 1) refuse(remeshes + "Leave out --shard.");
}

/// Returns the call without what only a mesh or only a volume has. Throws Error for a wrong call.
ExtractArguments checked_call(ExtractArguments arguments, bool is_mesh) {
  check_format(arguments.job.format);
  check_volume_options(arguments.job.volume);
  if (same_file(arguments.input, arguments.folder)) {
    refuse("\"" + arguments.input + "\" is the input itself. Give an output folder.");
  }
  if (arguments.is_conforming()) check_walls(arguments, is_mesh);
  check_conforming_options(arguments.walls);
  check_tetrahedra_arguments(arguments.tetrahedra);
  const std::string& smallest = arguments.smallest;
  const bool is_share = !smallest.empty() && smallest.back() == '%';
  if (!smallest.empty() && is_share != is_mesh) {
    refuse(is_mesh ? "The smallest body of a mesh is a part of its largest. Give a %: " +
                         mention("smallest", "0.1%") + "."
                   : "The smallest grain of a volume is a number of voxels. Give it without %: " +
                         mention("smallest", "100") + ".");
  }
  if (is_share) {
    const std::string number = smallest.substr(0, smallest.size() - 1);
    arguments.job.smallest_body = from_typed(number, smallest_body_option);
  } else if (!smallest.empty()) {
    arguments.job.volume.smallest = from_typed(smallest, smallest_option);
  }
  if (is_mesh) arguments.job.table = "bodies";
  return arguments;
}

CLI::App& add_arguments(CLI::App& program, ExtractArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"extract",
       "Write a mesh of each grain of a CT volume, or of each body of a mesh",
       {"labels.nrrd grains --smallest 1000", "labels.tif grains --voxel-size 0.012",
        "sample.stl bodies --smallest 0.1%", "labels.nrrd walls --edge-length 4"},
       "OUT gets one mesh per label or body, such as 12.ply, and labels.csv or bodies.csv "
       "with the state of each. The same call continues after an interruption. wscvt batch "
       "remeshes "
       "each grain of a volume, and with --parts each body of a mesh. With --edge-length, -n or "
       "--tetrahedra, extract remeshes all grains at once, with common walls; OUT then also gets "
       "walls.vtu, walls.msh, walls.csv and grains.csv.",
       true,
       true});
  add_file_argument(
      app, "input", arguments.input,
      "Labels: .tif, .nrrd, .mhd, .vti, .vtk, .nii, .npy, .npz, .h5, .mat, a folder of "
      ".tif or .png slices, or the .json beside a .raw. Or a mesh: .ply, .stl and others")
      ->required();
  add_output(app, "output", arguments.folder, "Output folder", "OUT");
  add_volume_arguments(app, arguments.job.volume, "Options");
  app.remove_option(app.get_option("--smallest"));
  add_typed(app, "--smallest",
            [&arguments](std::string_view text) { arguments.smallest = std::string(text); })
      ->description(
          "Smallest grain: voxels of a volume, or % of a mesh's largest body. Smaller ones, and "
          "open surfaces, are only listed. Default: 100, or 0%")
      ->type_name("N");
  app.add_flag("--describe", arguments.job.describe,
               help_of(arguments.job.describe, describe_option));
  add_number(app, "--edge-length", arguments.walls.edge_length, edge_length_option)
      ->description(
          "Remesh all grains at once with common walls and this mean edge length; 0: three voxels");
  add_number(app, "-n,--nodes", arguments.walls.nodes, wall_nodes_option)
      ->description(
          "Remesh all grains at once with common walls and about this number of nodes of each");
  add_tetrahedra_arguments(app, arguments.tetrahedra, "all grains, remeshed at once,");
  for (const char* name : {"--edge-length", "--nodes", "--tetrahedra"}) {
    arguments.of_walls.push_back(app.get_option(name));
  }
  add_format_argument(app, arguments.job.format);
  add_shard_argument(app, arguments.shard);
  add_threads_argument(app, arguments.threads);
  add_quiet_argument(app, arguments.quiet);
  move_to_finer_settings(app, {"--smoothing", "--background", "--at-border", "--select", "--shard",
                               "--threads", "--quiet"});
  return app;
}

int run(const ExtractArguments& given) {
  const auto begin = std::chrono::steady_clock::now();
  const bool is_mesh = !is_volume(given.input) && is_mesh_format(given.input, MeshUse::Read);
  const ExtractArguments arguments = checked([&] {
    if (is_mesh) check_mesh_input(given.input);
    ExtractArguments call = checked_call(given, is_mesh);
    if (!is_mesh && !is_volume(call.input)) open_volume(call.input);  // throws its error
    return call;
  });
  if (!arguments.quiet) check_writable("/dev/stdout");
  JoinedGrains grains(arguments.shard);
  if (is_mesh) {
    std::unique_ptr<BodyGrains> bodies = open_bodies(arguments);
    print_warnings(bodies->warnings());
    grains.add(std::move(bodies));
  } else {
    auto labels = open_grains(arguments.input, arguments.job.volume, arguments.quiet);
    if (arguments.is_conforming()) return run_conforming(arguments, *labels);
    print_notes(*labels, use_parts, arguments.quiet);
    grains.add(std::make_unique<LabelSource>(arguments.input, std::move(labels)));
  }
  const GrainJob job = make_job(arguments.job, arguments.folder, arguments.shard);
  const JobEnd end = run_job(job, grains, arguments.threads, arguments.quiet);
  if (end.was_cancelled()) return 128 + noted_signal();
  std::vector<std::string> lines = job.shard.count > 1
                                       ? std::vector<std::string>{end_line(job, end)}
                                       : write_census(arguments.job, job, grains);
  print_made(std::move(lines), arguments.folder, begin, arguments.quiet);
  return end.failed == 0 && !is_much_left_out(grains.left_out()) ? Done : SomeFailed;
}

}  // namespace

Command extract_command(CLI::App& program) { return make_command<ExtractArguments>(program); }

}  // namespace wscvt::program
