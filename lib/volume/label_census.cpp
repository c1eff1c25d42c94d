// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/label_census.h"

#include <algorithm>
#include <unordered_map>

#include "wscvt/base/error.h"

namespace wscvt {

bool LabelExtent::touches_border(const VoxelCounts& counts) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (begin[axis] == 0 || end[axis] == counts[axis]) return true;
  }
  return false;
}

std::vector<LabelExtent> label_census(LabelVolume& volume, Label background,
                                      const Execution& execution) {
  const VoxelCounts& counts = volume.geometry().counts;
  std::vector<LabelExtent> labels;
  std::unordered_map<Label, std::size_t> places;
  const auto count_stretch = [&](Label label, std::int32_t y, std::int32_t z, std::int32_t begin,
                                 std::int32_t end) {
    if (label == background) return true;
    const auto [place, is_new] = places.emplace(label, labels.size());
    if (is_new) {
      if (labels.size() == most_labels) {
        throw Error(ErrorCode::InvalidInput,
                    "The volume has more than " + std::to_string(most_labels) +
                        " labels: it seems to hold grey values. Segment it, and give the labels.");
      }
      labels.push_back({label, 0, {begin, y, z}, {end, y + 1, z + 1}});
    }
    LabelExtent& found = labels[place->second];
    found.voxels += static_cast<std::uint64_t>(end - begin);
    found.begin = {std::min(found.begin[0], begin), std::min(found.begin[1], y), found.begin[2]};
    found.end = {std::max(found.end[0], end), std::max(found.end[1], y + 1), z + 1};
    return true;
  };
  volume.rewind();
  for (std::int32_t z = 0; z < counts[2]; ++z) {
    execution.report(static_cast<double>(z) / counts[2], "Counting labels");
    for (std::int32_t y = 0; y < counts[1]; ++y) {
      visit_stretches(volume.next_row(), y, z, count_stretch);
    }
  }
  std::sort(labels.begin(), labels.end(),
            [](const LabelExtent& a, const LabelExtent& b) { return a.label < b.label; });
  return labels;
}

}  // namespace wscvt
