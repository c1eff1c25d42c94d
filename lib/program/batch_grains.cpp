// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_grains.h"

#include <algorithm>

#include "progress_line.h"
#include "signals.h"
#include "toolbox/volume/label_table.h"
#include "toolbox/volume/open_volume.h"
#include "volume_arguments.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/bodies.h"

namespace wscvt::program {

namespace {

/// Returns the bodies of a mesh file.
MeshBodies bodies_of(const std::string& path, bool quiet) {
  note_signals();
  ProgressLine line(!quiet);
  const Execution execution(1, [&](double fraction, const std::string& stage) {
    line.show(fraction, stage);
    return noted_signal() == 0;
  });
  MeshFile file = read_mesh_file(path, execution);
  return split_bodies(std::move(file.mesh), std::move(file.named_faces), execution);
}

}  // namespace

BatchGrains::BatchGrains(const std::vector<std::string>& files, const VolumeOptions& options,
                         const Shard& shard, bool quiet) {
  for (const std::string& path : files) {
    if (is_volume(path)) {
      add_volume(path, options, shard, quiet);
    } else {
      add_mesh(path, options, shard, quiet);
    }
  }
}

void BatchGrains::add_mesh(const std::string& path, const VolumeOptions& options,
                           const Shard& shard, bool quiet) {
  MeshBodies bodies;
  std::string error;
  if (options.parts) {
    try {
      bodies = bodies_of(path, quiet);
    } catch (const MachineRefused&) {
      throw;
    } catch (const Error& failure) {
      if (failure.code() == ErrorCode::Cancelled) throw;
      error = failure.what();
    }
  }
  if (bodies.list.size() < 2) {
    if (!is_of(shard, path)) return;
    names_.push_back(path);
    places_.push_back({error.empty() ? Place::File : Place::Refused, 0, errors_.size()});
    if (!error.empty()) errors_.push_back(error);
    return;
  }
  print({path + ": " + std::to_string(bodies.list.size()) + " bodies"}, quiet);
  print(bodies.warnings, quiet);
  for (std::size_t k = 0; k < bodies.list.size(); ++k) {
    MeshBody& body = bodies.list[k];
    const std::string name = path + "/" + std::to_string(k + 1);
    if (!body.name.empty()) print({"  " + std::to_string(k + 1) + ": " + body.name}, quiet);
    if (!is_of(shard, name)) continue;
    names_.push_back(name);
    places_.push_back({Place::Body, 0, bodies_.size()});
    bodies_.push_back(std::move(body.mesh));
  }
}

void BatchGrains::add_volume(const std::string& path, const VolumeOptions& options,
                             const Shard& shard, bool quiet) {
  std::unique_ptr<LabelGrains> grains = open_grains(path, options, quiet);
  print_notes(*grains, "wscvt batch " + path + " -o OUT", quiet);
  for (std::size_t k = 0; k < grains->taken().size(); ++k) {
    const std::string name = grain_name(path, grains->labels()[grains->taken()[k]].label);
    if (!is_of(shard, name)) continue;
    names_.push_back(name);
    places_.push_back({Place::Label, volumes_.size(), k});
  }
  paths_.push_back(path);
  volumes_.push_back(std::move(grains));
}

std::string BatchGrains::label_table(
    const std::function<std::string(const std::string&)>& file_of) const {
  if (volumes_.empty()) return "";
  std::string table = label_header();
  for (std::size_t volume = 0; volume < volumes_.size(); ++volume) {
    const LabelGrains& grains = *volumes_[volume];
    for (const LabelExtent& label : grains.labels()) {
      LabelOutcome outcome;
      if (grains.state(label) == LabelState::Taken) {
        outcome.file = file_of(grain_name(paths_[volume], label.label));
      }
      table += label_row(paths_[volume], grains, label, outcome);
    }
  }
  return table;
}

bool BatchGrains::is_much_left_out() const {
  return std::any_of(volumes_.begin(), volumes_.end(),
                     [](const std::unique_ptr<LabelGrains>& grains) {
                       return program::is_much_left_out(*grains);
                     });
}

void BatchGrains::begin(std::size_t first) {
  std::vector<std::vector<std::size_t>> wanted(volumes_.size());
  for (std::size_t k = first; k < places_.size(); ++k) {
    if (places_[k].kind != Place::Label) continue;
    wanted[places_[k].volume].push_back(places_[k].grain);
  }
  for (std::size_t volume = 0; volume < volumes_.size(); ++volume) {
    volumes_[volume]->want(wanted[volume]);
  }
}

GrainScan BatchGrains::read(std::size_t grain, bool with_pictures, const Execution& execution) {
  const Place& place = places_[grain];
  if (place.kind == Place::Body) return {bodies_[place.grain], {}, {}};
  if (place.kind == Place::Refused) throw Error(ErrorCode::InvalidInput, errors_[place.grain]);
  if (place.kind == Place::File) {
    MeshFile file = read_mesh_file(names_[grain], execution);
    if (with_pictures) read_pictures(file, names_[grain], execution);
    return {std::move(file.mesh), std::move(file.attributes), std::move(file.warnings)};
  }
  LabelGrain label = volumes_[place.volume]->read(place.grain, execution);
  if (label.mesh.points.empty()) {
    throw Error(ErrorCode::InvalidInput,
                "The label is in " + std::to_string(label.pieces) +
                    " pieces, and the largest has too few voxels for a grain. Segment it again.");
  }
  return {std::move(label.mesh), {}, warnings_of(label)};
}

}  // namespace wscvt::program
