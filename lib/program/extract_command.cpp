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
#include "grain_run.h"
#include "signals.h"
#include "volume/label_table.h"
#include "volume_arguments.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt::program {

namespace {

namespace fs = std::filesystem;

/// What came of a label that was taken.
enum class Made { Nothing, Mesh, MeshOfAPiece };

/// The rows of the labels, and how many came to what.
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

  /// On several threads at once, each for grains of its own.
  void note(std::size_t grain, Made made) { made_[grain] = made; }

  void take(std::size_t grain, const GrainRow& row) {
    rows_[grains_.taken()[grain]] = row.record;
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

int extract(const ExtractArguments& arguments) {
  const BatchArguments& sample = arguments.sample;
  check_mesh_format("mesh." + sample.format);
  if (!sample.quiet) check_writable("/dev/stdout");
  const std::unique_ptr<LabelGrains> grains =
      open_grains(arguments.volume, sample.volume, sample.quiet);
  const fs::path folder = sample.folder;
  std::error_code error;
  fs::create_directories(folder, error);
  const std::string table = (folder / "labels.csv").string();
  check_writable(table);
  LabelRows rows(arguments.volume, *grains);
  std::vector<std::size_t> all(grains->taken().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  grains->want(all);

  const auto label_of = [&](std::size_t k) -> const LabelExtent& {
    return grains->labels()[grains->taken()[k]];
  };
  GrainRun run;
  run.count = all.size();
  run.threads = sample.threads;
  run.quiet = sample.quiet;
  run.name = [&](std::size_t k) { return grain_name(arguments.volume, label_of(k).label); };
  run.work = [&](std::size_t k, const Execution& execution) {
    const auto row_of = [&](const LabelOutcome& outcome) -> GrainRow {
      return {label_row(arguments.volume, *grains, label_of(k), outcome), outcome.error};
    };
    return row_or_failure(
        [&] {
          const LabelGrain grain = grains->read(k, execution);
          LabelOutcome outcome{&grain, "", ""};
          if (!grain.mesh.points.empty()) {
            outcome.file = std::to_string(label_of(k).label) + "." + sample.format;
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
  const GrainRunEnd end = run_grains(run);
  if (end.was_cancelled) {
    std::fprintf(stderr, " There is no table.\n");
    return 128 + noted_signal();
  }
  write_file(table, rows.table());
  print({rows.summary(end.failed)}, sample.quiet);
  return end.failed == 0 ? Done : SomeFailed;
}

}  // namespace

CLI::App& add_command(CLI::App& program, ExtractArguments& arguments) {
  BatchArguments& sample = arguments.sample;
  CLI::App& app = add_command(
      program, {"extract",
                "Make a mesh of each grain of a segmented CT volume",
                {"labels.nrrd grains --smallest 1000", "labels.tif grains --voxel-size 0.012",
                 "slices remeshes --remesh -n 500"},
                "OUT gets a mesh a label, named by it, and labels.csv, which says what became of "
                "each. With\n"
                "--remesh it gets what wscvt batch makes, without dense meshes in between.",
                true});
  add_file_argument(app, "volume", arguments.volume,
                    "Labels: .tif or a folder of slices, .nrrd, .mhd, .vti, or the .json beside a "
                    ".raw")
      ->required();
  app.add_option("output", sample.folder, "Folder for all that is made")
      ->type_name("OUT")
      ->required();
  add_volume_arguments(app, sample.volume, "Options");
  app.add_flag("--remesh", arguments.remesh,
               "Remesh the grains as wscvt batch does, with its options");
  const std::size_t before = app.get_options().size();
  add_sample_arguments(app, sample);
  std::vector<CLI::Option*> of_remesh;
  const std::vector<CLI::Option*> options =
      app.get_options([](const CLI::Option*) { return true; });
  for (std::size_t k = before; k < options.size(); ++k) {
    if (options[k]->get_name() == "--format") continue;
    of_remesh.push_back(options[k]);
    if (options[k]->get_name() != "--nodes") options[k]->group(finer_settings);
  }
  // Not by CLI11's needs(), which the help would then say of each.
  app.parse_complete_callback([&arguments, of_remesh] {
    for (const CLI::Option* option : of_remesh) {
      if (arguments.remesh || option->count() == 0) continue;
      throw CLI::ValidationError(option->get_name(), "This is of a remesh; give --remesh too.");
    }
  });
  add_threads_argument(app, sample.threads);
  app.add_flag("-q,--quiet", sample.quiet,
               "No summary on the standard output, no progress; failures stay");
  return app;
}

int run(const ExtractArguments& arguments) {
  if (!arguments.remesh) return extract(arguments);
  if (!is_volume(arguments.volume)) open_volume(arguments.volume);  // throws what is wrong with it
  BatchArguments sample = arguments.sample;
  sample.inputs = {arguments.volume};
  return run(sample);
}

}  // namespace wscvt::program
