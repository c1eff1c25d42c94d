// SPDX-License-Identifier: GPL-3.0-or-later
#include "extract_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <vector>

#include "command.h"
#include "common_arguments.h"
#include "exit_code.h"
#include "job_on_terminal.h"
#include "output_paths.h"
#include "signals.h"
#include "toolbox/conforming/conforming_files.h"
#include "toolbox/job/grain_files.h"
#include "toolbox/volume/label_table.h"
#include "toolbox/volume/open_volume.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::program {

namespace {

namespace fs = std::filesystem;

/// Outcome of a label that was used.
enum class Made { Nothing, Mesh, MeshOfAPiece };

/// Rows of the labels, and numbers of their outcomes.
class LabelRows {
 public:
  LabelRows(const std::string& volume, const LabelGrains& grains)
      : grains_(grains), rows_(grains.labels().size()), made_(grains.taken().size()) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const LabelExtent& label = grains.labels()[k];
      const LabelState state = grains.state(label);
      if (state == LabelState::Taken) continue;
      rows_[k] = label_row(volume, grains, label, {});
      ++(state == LabelState::TooSmall ? too_small_ : at_border_);
    }
  }

  /// May be called on several threads at once, for different grains.
  void note(std::size_t grain, Made made) { made_[grain] = made; }

  void take(std::size_t grain, const GrainRow& row) {
    rows_[grains_.taken()[grain]] = row.records.front();
    const Made made = made_[grain];
    if (made == Made::MeshOfAPiece) ++in_pieces_;
    if (made != Made::Nothing) {
      ++written_;
    } else if (row.error.empty()) {
      ++too_small_;
    }
  }

  std::string table() const { return std::accumulate(rows_.begin(), rows_.end(), label_header()); }

  std::string summary(std::size_t failed) const {
    std::string text =
        std::to_string(rows_.size()) + " labels: " + std::to_string(written_) + " written";
    const auto add = [&](std::size_t count, const char* what) {
      if (count > 0) text += ", " + std::to_string(count) + what;
    };
    if (in_pieces_ > 0) text += " (" + std::to_string(in_pieces_) + " in pieces)";
    add(at_border_, " at the border");
    add(too_small_, " too small");
    add(failed, " failed");
    return text;
  }

 private:
  const LabelGrains& grains_;
  std::vector<std::string> rows_;
  std::vector<Made> made_;
  std::size_t written_ = 0;
  std::size_t in_pieces_ = 0;
  std::size_t at_border_ = 0;
  std::size_t too_small_ = 0;
};

constexpr FlagOption conforming_option = {
    "conforming", "remesh all grains at once",
    "with common walls; OUT also gets walls.vtu, walls.msh, walls.csv and grains.csv"};

/// Remeshes all taken labels at once.
int run_conforming(const ExtractArguments& arguments, LabelGrains& grains) {
  std::vector<Label> labels;
  for (const LabelExtent& label : grains.labels()) {
    if (grains.state(label) == LabelState::Taken) labels.push_back(label.label);
  }
  if (labels.empty()) {
    refuse("No label of \"" + arguments.volume + "\" is a grain to mesh. Give " +
           mention(at_border_option) + " or a smaller " + mention(smallest_option) + ".");
  }
  CommonArguments common;
  common.threads = arguments.threads;
  common.quiet = arguments.quiet;
  Work work(common);
  const MadeFolder folder(arguments.folder);
  const auto in_folder = [&](const std::string& name) {
    return (fs::path(arguments.folder) / name).string();
  };
  check_writable(in_folder("grains.csv"));
  ConformingOptions options = arguments.walls;
  options.smoothing = arguments.options.smoothing;
  const ConformingGrains result =
      conform_labels(grains.voxels(), labels, options, work.execution());
  const std::vector<IndexedMesh> meshes = grain_meshes(result);
  std::vector<std::string> files;
  for (std::size_t g = 0; g < labels.size(); ++g) {
    files.push_back(std::to_string(labels[g]) + "." + arguments.format);
    work.write(in_folder(files.back()),
               [&](const std::string& path, const Execution&) { write_mesh(meshes[g], path); });
  }
  const auto write = [&](const char* name, const std::string& text) {
    work.write(in_folder(name),
               [&](const std::string& path, const Execution&) { write_file(path, text); });
  };
  const std::string rows =
      std::accumulate(grains.labels().begin(), grains.labels().end(), label_header(),
                      [&](std::string text, const LabelExtent& label) {
                        return std::move(text) + label_row(arguments.volume, grains, label, {});
                      });
  write("labels.csv", rows);
  write("walls.vtu", walls_vtu(result, labels));
  write("walls.msh", walls_msh(result, labels));
  write("walls.csv", walls_csv(result, labels));
  write("grains.csv", conforming_csv(result, labels, files));
  const Sentence warning = intersection_warning(result, labels);
  work.print(warning.empty() ? std::vector<Sentence>() : std::vector<Sentence>{warning},
             conforming_lines(result));
  return is_much_left_out(grains.left_out()) ? SomeFailed : Done;
}

}  // namespace

CLI::App& add_command(CLI::App& program, ExtractArguments& arguments) {
  CLI::App& app = add_command(
      program, {"extract",
                "Make a mesh of each grain of a segmented CT volume",
                {"labels.nrrd grains --smallest 1000", "labels.tif grains --voxel-size 0.012",
                 "labels.nrrd grains --conforming --edge-length 4"},
                "OUT gets one mesh per label, such as 12.ply, and labels.csv with the state of "
                "every label.\n"
                "wscvt batch reads volumes too and remeshes their grains.",
                false,
                true});
  add_file_argument(
      app, "volume", arguments.volume,
      "Labels: .tif, .nrrd, .mhd, .vti, .vtk, .nii, .npy, .npz, .h5, .mat, a folder of "
      ".tif or .png slices, or the .json beside a .raw")
      ->required();
  add_output(app, "output", arguments.folder, "Output folder", "OUT");
  add_volume_arguments(app, arguments.options, "Options");
  app.add_flag("--conforming", arguments.conforming,
               help_of(arguments.conforming, conforming_option));
  add_number(app, "--edge-length", arguments.walls.edge_length, edge_length_option);
  add_format_argument(app, arguments.format);
  add_threads_argument(app, arguments.threads);
  app.add_flag("-q,--quiet", arguments.quiet, "Print only warnings and failures");
  return app;
}

int run(const ExtractArguments& arguments) {
  checked([&] {
    check_format(arguments.format);
    check_volume_options(arguments.options);
    if (!arguments.conforming && arguments.walls.edge_length > 0.0) {
      refuse(mention(edge_length_option) + " is only for " + mention(conforming_option) + ".");
    }
    if (same_file(arguments.volume, arguments.folder)) {
      refuse("\"" + arguments.volume + "\" is the volume itself. Give an output folder.");
    }
    if (!is_volume(arguments.volume) && is_mesh_file(arguments.volume)) {
      refuse("\"" + arguments.volume +
             "\" is a mesh, not a volume. wscvt split MESH FOLDER writes each of its bodies, and "
             "wscvt batch MESH -o OUT --parts remeshes them.");
    }
    if (!is_volume(arguments.volume)) open_volume(arguments.volume);  // throws its error
  });
  if (!arguments.quiet) check_writable("/dev/stdout");
  const std::unique_ptr<LabelGrains> grains =
      open_grains(arguments.volume, arguments.options, arguments.quiet);
  print_notes(*grains, "wscvt extract " + arguments.volume + " " + arguments.folder,
              arguments.quiet);
  if (arguments.conforming) return run_conforming(arguments, *grains);
  const fs::path folder = arguments.folder;
  std::error_code error;
  fs::create_directories(folder, error);
  const std::string table = (folder / "labels.csv").string();
  check_writable(table);
  remove_partial_file(table);
  LabelRows rows(arguments.volume, *grains);
  std::vector<std::size_t> all(grains->taken().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  grains->want(all);

  const auto label_of = [&](std::size_t k) -> const LabelExtent& {
    return grains->labels()[grains->taken()[k]];
  };
  const auto file_of = [&](std::size_t k) {
    return std::to_string(label_of(k).label) + "." + arguments.format;
  };
  // Files of a killed call.
  for (const std::size_t k : all) remove_partial_file((folder / file_of(k)).string());
  GrainRun run;
  run.count = all.size();
  run.when_stopped = "No table was written. The same call starts from the beginning.";
  run.name = [&](std::size_t k) { return grain_name(arguments.volume, label_of(k).label); };
  run.work = [&](std::size_t k, const Execution& execution) {
    const auto row_of = [&](const LabelOutcome& outcome) -> GrainRow {
      return {{label_row(arguments.volume, *grains, label_of(k), outcome)}, outcome.error};
    };
    return row_or_failure(
        [&] {
          const LabelGrain grain = grains->read(k, execution);
          LabelOutcome outcome{&grain, "", ""};
          if (!grain.mesh.points.empty()) {
            outcome.file = file_of(k);
            write_mesh(grain.mesh, (folder / outcome.file).string());
            rows.note(k, grain.pieces > 1 ? Made::MeshOfAPiece : Made::Mesh);
          }
          return row_of(outcome);
        },
        [&](const std::string& sentence) {
          return row_of({nullptr, "", sentence});
        });
  };
  run.take = [&](std::size_t k, const GrainRow& row) { rows.take(k, row); };
  const JobEnd end = run_grains(run, arguments.threads, arguments.quiet);
  if (end.was_cancelled()) return 128 + noted_signal();
  write_file(table, rows.table());
  print({rows.summary(end.failed)}, arguments.quiet);
  return end.failed == 0 && !is_much_left_out(grains->left_out()) ? Done : SomeFailed;
}

}  // namespace wscvt::program
