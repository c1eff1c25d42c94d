// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/label_census.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "toolbox/volume/volume_parts.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

/// Counts voxels of labels and of their parts. A part that does not extend into the next slice is
/// complete, so memory is only the parts of a slice.
class Census {
 public:
  Census(const VoxelCounts& counts, Label background) : tracker_(counts, background) {}

  void add_row(const std::vector<Label>& row, std::int32_t y, std::int32_t z) {
    const auto begin_part = [&](Label label) {
      parts_.push_back({place_of(label), 0});
      return joined_.add();
    };
    const auto link = [&](std::uint32_t a, std::uint32_t b) { joined_.join(a, b); };
    for (const PartTracker::Stretch& stretch : tracker_.add_row(row, begin_part, link)) {
      Part& part = parts_[stretch.part];
      const auto voxels = static_cast<std::uint64_t>(stretch.end - stretch.begin);
      part.voxels += voxels;
      LabelExtent& label = labels_[part.label];
      label.voxels += voxels;
      label.begin = {std::min(label.begin[0], stretch.begin), std::min(label.begin[1], y),
                     std::min(label.begin[2], z)};
      label.end = {std::max(label.end[0], stretch.end), std::max(label.end[1], y + 1), z + 1};
    }
  }

  void end_slice() {
    // The part that represents joined parts has all their voxels.
    for (std::uint32_t part = 0; part < parts_.size(); ++part) {
      const std::uint32_t root = joined_.find(part);
      if (root != part) parts_[root].voxels += parts_[part].voxels;
    }
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> places(parts_.size(), none);
    std::vector<Part> kept;
    tracker_.renumber_slice([&](std::uint32_t part) {
      std::uint32_t& place = places[joined_.find(part)];
      if (place == none) {
        place = static_cast<std::uint32_t>(kept.size());
        kept.push_back(parts_[joined_.find(part)]);
      }
      return place;
    });
    for (std::uint32_t part = 0; part < parts_.size(); ++part) {
      if (joined_.find(part) == part && places[part] == none) finish(parts_[part]);
    }
    parts_.swap(kept);
    joined_.clear();
    for (std::size_t k = 0; k < parts_.size(); ++k) joined_.add();
  }

  std::vector<LabelExtent> labels() {
    for (const Part& part : parts_) finish(part);
    std::sort(labels_.begin(), labels_.end(),
              [](const LabelExtent& a, const LabelExtent& b) { return a.label < b.label; });
    return std::move(labels_);
  }

 private:
  struct Part {
    std::size_t label = 0;  ///< index of the label
    std::uint64_t voxels = 0;
  };

  std::size_t place_of(Label label) {
    const auto [place, is_new] = places_.emplace(label, labels_.size());
    if (!is_new) return place->second;
    if (labels_.size() == most_labels) {
      refuse("The volume has more than " + std::to_string(most_labels) +
             " labels: it seems to have grey values. Make labels of them by wscvt segment.");
    }
    LabelExtent extent;
    extent.label = label;
    extent.begin.fill(std::numeric_limits<std::int32_t>::max());
    labels_.push_back(extent);
    return place->second;
  }

  void finish(const Part& part) {
    LabelExtent& label = labels_[part.label];
    ++label.pieces;
    label.largest_piece = std::max(label.largest_piece, part.voxels);
  }

  PartTracker tracker_;
  JoinedNumbers joined_;
  std::vector<Part> parts_;
  std::vector<LabelExtent> labels_;
  std::unordered_map<Label, std::size_t> places_;
};

}  // namespace

void GreyCheck::Neighbours::count(const Label* a, const Label* b, std::size_t size,
                                  Label background) {
  for (std::size_t k = 0; k < size; ++k) {
    const bool are_labels = (a[k] != background) & (b[k] != background);
    all += are_labels ? 1 : 0;
    different += (are_labels & (a[k] != b[k])) ? 1 : 0;
  }
}

void GreyCheck::add_row(const std::vector<Label>& row, std::int32_t y) {
  along_x_.count(row.data(), row.data() + 1, row.size() - 1, background_);
  if (y > 0) along_y_.count(row.data(), before_.data(), row.size(), background_);
  before_ = row;
}

void GreyCheck::check(std::uint64_t fewest) const {
  constexpr double most = 0.5;
  if (along_x_.all < fewest || along_y_.all < fewest) return;
  const double fraction = std::min(along_x_.fraction(), along_y_.fraction());
  if (fraction <= most) return;
  refuse("These look like grey values, not labels: " + format_percent(fraction) +
         " of all neighbouring voxels differ. Make labels of them first: wscvt segment "
         "SCAN labels.nrrd.");
}

bool LabelExtent::touches_border(const VoxelCounts& counts) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (begin[axis] == 0 || end[axis] == counts[axis]) return true;
  }
  return false;
}

std::vector<LabelExtent> label_census(LabelVolume& volume, Label background,
                                      const Execution& execution) {
  const VoxelCounts& counts = volume.geometry().counts;
  Census census(counts, background);
  GreyCheck check(background);
  for_each_row(volume, execution, "Counting labels",
               [&](const std::vector<Label>& row, std::int32_t y, std::int32_t z) {
                 census.add_row(row, y, z);
                 check.add_row(row, y);
                 if (y + 1 < counts[1]) return;
                 census.end_slice();
                 check.end_slice();
               });
  check.end();
  return census.labels();
}

}  // namespace wscvt
