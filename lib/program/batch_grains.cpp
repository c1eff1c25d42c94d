// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_grains.h"

#include <algorithm>

#include "volume/label_table.h"
#include "volume_arguments.h"
#include "wscvt/base/error.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt::program {

BatchGrains::BatchGrains(const std::vector<std::string>& files, const VolumeOptions& options,
                         const Shard& shard, bool quiet) {
  for (const std::string& path : files) {
    if (is_volume(path)) {
      add_volume(path, options, shard, quiet);
    } else if (is_of(shard, path)) {
      names_.push_back(path);
      places_.push_back({-1, 0});
    }
  }
}

void BatchGrains::add_volume(const std::string& path, const VolumeOptions& options,
                             const Shard& shard, bool quiet) {
  std::unique_ptr<LabelGrains> grains = open_grains(path, options, quiet);
  print_notes(*grains, "wscvt batch " + path + " -o OUT", quiet);
  const auto volume = static_cast<std::ptrdiff_t>(volumes_.size());
  for (std::size_t k = 0; k < grains->taken().size(); ++k) {
    const std::string name = grain_name(path, grains->labels()[grains->taken()[k]].label);
    if (!is_of(shard, name)) continue;
    names_.push_back(name);
    places_.push_back({volume, k});
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
    if (places_[k].volume < 0) continue;
    wanted[static_cast<std::size_t>(places_[k].volume)].push_back(places_[k].grain);
  }
  for (std::size_t volume = 0; volume < volumes_.size(); ++volume) {
    volumes_[volume]->want(wanted[volume]);
  }
}

GrainScan BatchGrains::read(std::size_t grain, const Execution& execution) {
  const Place& place = places_[grain];
  if (place.volume < 0) {
    MeshFile file = read_mesh_file(names_[grain], execution);
    return {std::move(file.mesh), std::move(file.warnings)};
  }
  LabelGrain label = volumes_[static_cast<std::size_t>(place.volume)]->read(place.grain, execution);
  if (label.mesh.points.empty()) {
    throw Error(ErrorCode::InvalidInput,
                "The label is in " + std::to_string(label.pieces) +
                    " pieces, of which the largest is smaller than the smallest grain that is "
                    "taken; segment it again.");
  }
  return {std::move(label.mesh), warnings_of(label)};
}

}  // namespace wscvt::program
