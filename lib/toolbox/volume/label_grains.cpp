// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/label_grains.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/open_volume.h"
#include "toolbox/volume/segmentation.h"
#include "toolbox/volume/volume_parts.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

void check_volume_options(const VolumeOptions& options) {
  if (!std::isnan(options.background)) require_in_range(options.background, background_option);
  require_in_range(options.smallest, smallest_option);
  require_in_range(options.smoothing, smoothing_option);
  if (options.separate) {
    require_in_range(*options.separate, separate_option);
    require_filters();
  }
  if (options.choice.channel) require_in_range(*options.choice.channel, channel_option);
  if (options.choice.frame) require_in_range(*options.choice.frame, frame_option);
  if (!options.choice.voxel_size) return;
  for (const double size : *options.choice.voxel_size) require_in_range(size, voxel_size_option);
}

LabelGrains::LabelGrains(const std::string& path, const VolumeOptions& options,
                         const Execution& execution)
    : LabelGrains([path, choice = options.choice] { return open_volume(path, choice); }, path,
                  options, execution) {}

LabelGrains::LabelGrains(std::function<std::unique_ptr<LabelVolume>()> open,
                         const std::string& name, const VolumeOptions& options,
                         const Execution& execution)
    : options_(options), open_(std::move(open)) {
  check_volume_options(options);
  try {
    find_labels(false, execution);
  } catch (const LargeNumber&) {
    find_labels(true, execution);
  }
  if (labels_.empty()) {
    refuse("\"" + name + "\" has no label except the background, " +
           (std::isnan(options.background) ? std::string("nan")
                                           : format_number(options.background, 17)) +
           ". Check it, or give " + mention("background") + ".");
  }
  for (std::size_t k = 0; k < labels_.size(); ++k) {
    if (state(labels_[k]) == LabelState::Taken) taken_.push_back(k);
  }
  std::stable_sort(taken_.begin(), taken_.end(), [&](std::size_t a, std::size_t b) {
    return labels_[a].end[2] < labels_[b].end[2];
  });
  warnings_ = volume_->warnings();
  if (taken_.empty()) warnings_.push_back(none_taken());
}

Sentence LabelGrains::none_taken() const {
  if (!taken_.empty()) return "";
  const auto small = static_cast<std::size_t>(std::count_if(
      labels_.begin(), labels_.end(),
      [&](const LabelExtent& label) { return state(label) == LabelState::TooSmall; }));
  const std::size_t cut = labels_.size() - small;
  std::string why;
  Sentence advice;
  if (cut > 0) {
    why = format_count(cut, "lies", "lie") + " at the border";
    advice = mention(at_border_option);
  }
  if (small > 0) {
    why += (cut > 0 ? " and " : "") + format_count(small, "is", "are") + " too small";
    advice += (cut > 0 ? " or a smaller " : "a smaller ") + mention(smallest_option);
  }
  return "No label is a grain to mesh: of " + format_count(labels_.size(), "label") + " " + why +
         ". Give " + advice + ".";
}

void LabelGrains::find_labels(bool anew, const Execution& execution) {
  volume_ = open_();
  volume_->set_background(options_.background);
  if (anew) volume_->number_anew(most_labels);
  Label background = anew ? 0 : background_label(options_.background);
  const bool is_numbered_anew = options_.parts || options_.separate;
  const Execution numbering = execution.part(0.0, 0.5);
  if (options_.separate) {
    volume_ = separated(*volume_, background, *options_.separate, numbering);
  } else if (options_.parts) {
    volume_ = parts_of(std::move(volume_), background, numbering);
  }
  if (is_numbered_anew) background = 0;
  labels_ =
      label_census(*volume_, background, is_numbered_anew ? execution.part(0.5, 1.0) : execution);
}

std::string LabelGrains::name_of(Label label) const {
  const auto found = volume_->names().find(label);
  return found == volume_->names().end() ? "" : found->second;
}

double LabelGrains::left_out() const {
  if (taken_.empty()) return 1.0;
  std::uint64_t all = 0;
  std::uint64_t left_out = 0;
  for (const std::size_t k : taken_) {
    const LabelExtent& label = labels_[k];
    const bool is_kept = static_cast<std::int64_t>(label.largest_piece) >= options_.smallest;
    all += label.voxels;
    left_out += label.voxels - (is_kept ? label.largest_piece : 0);
  }
  return static_cast<double>(left_out) / static_cast<double>(all);
}

LabelState LabelGrains::state(const LabelExtent& label) const {
  if (static_cast<std::int64_t>(label.voxels) < options_.smallest) return LabelState::TooSmall;
  const bool is_cut = !options_.at_border && label.touches_border(geometry().counts);
  return is_cut ? LabelState::AtTheBorder : LabelState::Taken;
}

void LabelGrains::want(const std::vector<std::size_t>& grains) {
  const std::lock_guard<std::mutex> lock(mutex_);
  at_work_.clear();
  for (const std::size_t grain : grains) at_work_[labels_[taken_[grain]].label];
  next_slice_ = 0;
  volume_->rewind();
}

LabelVolume& LabelGrains::voxels() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_behind_ = true;
  volume_->rewind();
  return *volume_;
}

void LabelGrains::read_to(std::int32_t slice, const Execution& execution) {
  if (is_behind_) {
    for (auto& [label, stretches] : at_work_) stretches.clear();
    volume_->rewind();
    next_slice_ = 0;
  }
  is_behind_ = true;  // in case the following code throws
  for (; next_slice_ < slice; ++next_slice_) {
    execution.report(0.0, "Reading the volume");
    for (std::int32_t y = 0; y < geometry().counts[1]; ++y) {
      visit_stretches(volume_->next_row(), [&](Label found, std::int32_t begin, std::int32_t end) {
        const auto place = at_work_.find(found);
        if (place != at_work_.end()) place->second.push_back({next_slice_, y, begin, end});
      });
    }
  }
  is_behind_ = false;
}

std::vector<VoxelStretch> LabelGrains::stretches_of(std::size_t grain, const Execution& execution) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const LabelExtent& label = labels_[taken_[grain]];
  const auto [place, was_read_before] = at_work_.try_emplace(label.label);
  if (was_read_before) is_behind_ = true;
  try {
    read_to(label.end[2], execution);
  } catch (const Error& error) {
    // The whole volume was readable when the labels were found.
    if (error.code() == ErrorCode::InputOutput) throw MachineRefused(error.what());
    throw;
  }
  std::vector<VoxelStretch> stretches = std::move(place->second);
  at_work_.erase(place);
  return stretches;
}

LabelGrain LabelGrains::read(std::size_t grain, const Execution& execution) {
  const VoxelSurface surface = voxel_surface(stretches_of(grain, execution));
  LabelGrain result;
  result.pieces = surface.pieces;
  result.enclosed = surface.enclosed;
  result.piece_voxels = surface.piece_voxels;
  result.pore_voxels = surface.pore_voxels;
  if (surface.enclosed >= options_.smallest) {
    result.mesh = smoothed_surface(surface, options_.smoothing, geometry());
  }
  return result;
}

std::string refusal_of(const LabelGrain& grain) {
  if (!grain.mesh.points.empty()) return "";
  return "The label is in " + std::to_string(grain.pieces) +
         " pieces, and the largest has too few voxels for a grain. Segment it again.";
}

std::vector<std::string> warnings_of(const LabelGrain& grain) {
  std::vector<std::string> warnings;
  if (grain.pieces > 1) {
    warnings.push_back(
        "The label is in " + std::to_string(grain.pieces) +
        " pieces. The largest was used. The others, " +
        format_percent(1.0 - static_cast<double>(grain.enclosed) /
                                 static_cast<double>(grain.piece_voxels)) +
        " of the volume, were left out. If they are grains, segment the volume again.");
  }
  if (grain.pore_voxels > 0) {
    warnings.push_back("The label has pores of " +
                       format_percent(static_cast<double>(grain.pore_voxels) /
                                      static_cast<double>(grain.piece_voxels)) +
                       " of its volume. They were filled.");
  }
  return warnings;
}

}  // namespace wscvt
