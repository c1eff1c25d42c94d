// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

#include "toolbox/volume/segmentation_steps.h"

namespace wscvt {

namespace {

/// The values at the corners of all slices, and whether there are voxels that are not a number.
struct Corners {
  std::map<Label, std::size_t> values;
  bool has_nan = false;
};

Corners corners_of(LabelVolume& scan, const Execution& execution) {
  const VoxelCounts& counts = scan.geometry().counts;
  Corners corners;
  for_each_row(scan, execution, "Reading the volume",
               [&](const std::vector<Label>& row, std::int32_t y, std::int32_t /*z*/) {
                 corners.has_nan =
                     corners.has_nan || std::find(row.begin(), row.end(), 0) != row.end();
                 if (y != 0 && y + 1 != counts[1]) return;
                 ++corners.values[row.front()];
                 ++corners.values[row.back()];
               });
  return corners;
}

/// Changes 2 to 1 where it is connected to the border by faces, and to 0 elsewhere.
void keep_connected_to_border(std::vector<std::uint8_t>& marks, const VoxelCounts& counts) {
  const auto width = static_cast<std::size_t>(counts[0]);
  const auto slice = width * static_cast<std::size_t>(counts[1]);
  std::vector<std::size_t> open;
  const auto take = [&](std::size_t k) {
    if (marks[k] != 2) return;
    marks[k] = 1;
    open.push_back(k);
  };
  const auto is_at_border = [&](std::size_t k) {
    const std::array<std::size_t, 3> place = {k % width, k % slice / width, k / slice};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (place[axis] == 0 || place[axis] + 1 == static_cast<std::size_t>(counts[axis]))
        return true;
    }
    return false;
  };
  for (std::size_t k = 0; k < marks.size(); ++k) {
    if (marks[k] == 2 && is_at_border(k)) take(k);
  }
  while (!open.empty()) {
    const std::size_t k = open.back();
    open.pop_back();
    for_each_neighbour(k, counts, take);
  }
  std::replace(marks.begin(), marks.end(), std::uint8_t{2}, std::uint8_t{0});
}

/// Whether the voxels of 0 are nearly convex along each axis, and reach across the volume.
bool leaves_a_convex_body(const std::vector<std::uint8_t>& marks, const VoxelCounts& counts) {
  const std::array<std::size_t, 3> steps = {
      1, static_cast<std::size_t>(counts[0]),
      static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1])};
  std::size_t left = 0;
  std::size_t gaps = 0;
  bool reaches_across = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto length = static_cast<std::size_t>(counts[axis]);
    bool has_first = false;
    bool has_last = false;
    for (std::size_t begin = 0; begin < marks.size(); ++begin) {
      if (begin / steps[axis] % length != 0) continue;
      std::size_t pending = 0;
      bool is_in = false;
      for (std::size_t k = 0; k < length; ++k) {
        if (marks[begin + k * steps[axis]] != 0) {
          ++pending;
          continue;
        }
        ++left;
        if (is_in) gaps += pending;
        pending = 0;
        is_in = true;
        has_first = has_first || k == 0;
        has_last = has_last || k + 1 == length;
      }
    }
    reaches_across = reaches_across || (has_first && has_last);
  }
  constexpr double most_gaps = 0.02;  // noise that has the value by chance
  return reaches_across && static_cast<double>(gaps) < most_gaps * static_cast<double>(left);
}

}  // namespace

std::vector<std::uint8_t> not_scanned(LabelVolume& scan, const Execution& execution) {
  const VoxelCounts& counts = scan.geometry().counts;
  const Corners corners = corners_of(scan, execution.part(0.0, 0.5));
  std::size_t all = 0;
  std::pair<Label, std::size_t> most = {0, 0};
  for (const auto& [value, count] : corners.values) {
    all += count;
    if (value != 0 && count > most.second) most = {value, count};
  }
  const bool is_filled = 10 * most.second > 7 * all;
  if (!is_filled && !corners.has_nan) return {};
  std::vector<std::uint8_t> nan;
  std::vector<std::uint8_t> filled;
  for_each_row(scan, execution.part(0.5, 1.0), "Reading the volume",
               [&](const std::vector<Label>& row) {
                 for (const Label value : row) {
                   if (corners.has_nan) nan.push_back(value == 0 ? 2 : 0);
                   if (is_filled) filled.push_back(value == most.first ? 2 : 0);
                 }
               });
  keep_connected_to_border(nan, counts);
  keep_connected_to_border(filled, counts);
  const auto count_of = [](const std::vector<std::uint8_t>& marks) {
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
  };
  constexpr std::size_t fewest = 200;  // of so many voxels one
  const std::size_t found = count_of(filled);
  if (found * fewest < filled.size() || found == filled.size() ||
      !leaves_a_convex_body(filled, counts)) {
    filled.clear();
  }
  if (count_of(nan) == 0) return filled;
  for (std::size_t k = 0; k < filled.size(); ++k) nan[k] |= filled[k];
  return nan;
}

}  // namespace wscvt
