// SPDX-License-Identifier: GPL-3.0-or-later
// What a segmentation leaves out: what was not scanned, and the wall of a container.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/segmentation_steps.h"

namespace wscvt {

namespace {

/// The values at the corners of all slices, if three voxels there have one, as noise seldom has,
/// and whether there are voxels that are not a number.
struct Corners {
  std::map<Label, std::size_t> values;
  std::size_t all = 0;
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
                 corners.all += 2;
                 if (row.size() < 3) return;
                 const std::size_t last = row.size() - 1;
                 if (row[0] == row[1] && row[0] == row[2]) ++corners.values[row[0]];
                 if (row[last] == row[last - 1] && row[last] == row[last - 2]) {
                   ++corners.values[row[last]];
                 }
               });
  return corners;
}

/// Changes 1 to 0 where it is not connected to the border by faces.
void keep_connected_to_border(std::vector<std::uint8_t>& marks, const VoxelCounts& counts,
                              const Execution& execution) {
  if (marks.empty()) return;
  const auto invert = [&] {
    for (std::uint8_t& mark : marks) mark ^= 1U;
  };
  invert();
  fill_holes(marks, counts, execution);
  invert();
}

/// Whether a body has both ends along an axis that a scan has: at the border of the volume, or a
/// plane, as where slices were added. A convex grain has neither. `sections`: voxels of the body in
/// each slice across the axis.
bool is_cut_at_both_ends(const std::vector<std::size_t>& sections) {
  const std::size_t largest = *std::max_element(sections.begin(), sections.end());
  const auto is_cut = [&](auto first, auto end) {
    if (*first > 0) return true;
    return 2 * *std::find_if(first, end, [](std::size_t count) { return count > 0; }) > largest;
  };
  return largest > 0 && is_cut(sections.begin(), sections.end()) &&
         is_cut(sections.rbegin(), sections.rend());
}

/// Whether the voxels of 0 are nearly convex along each axis, and cut at both ends of one.
bool leaves_a_convex_body(const std::vector<std::uint8_t>& marks, const VoxelCounts& counts) {
  const VoxelGrid grid(counts);
  std::size_t left = 0;
  std::size_t gaps = 0;
  bool is_cut = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t length = grid.sizes[axis];
    const std::size_t step = grid.steps[axis];
    std::vector<std::size_t> sections(length, 0);
    for (std::size_t begin = 0; begin < marks.size(); ++begin) {
      if (begin / step % length != 0) continue;
      std::size_t pending = 0;
      bool is_in = false;
      for (std::size_t k = 0; k < length; ++k) {
        if (marks[begin + k * step] != 0) {
          ++pending;
          continue;
        }
        ++left;
        if (is_in) gaps += pending;
        pending = 0;
        is_in = true;
        ++sections[k];
      }
    }
    is_cut = is_cut || is_cut_at_both_ends(sections);
  }
  constexpr double most_gaps = 0.02;  // noise that has the value by chance
  return is_cut && static_cast<double>(gaps) < most_gaps * static_cast<double>(left);
}

/// Whether all voxels of 0 beside voxels of 1, along x, have one value, as those of a box in a made
/// scan have. A scan ends in void and material.
bool has_one_value_at_its_sides(LabelVolume& scan, const std::vector<std::uint8_t>& marks,
                                const Execution& execution) {
  std::optional<Label> first;
  bool is_one = true;
  std::size_t begin = 0;
  for_each_row(scan, execution, "Reading the volume", [&](const std::vector<Label>& row) {
    for (std::size_t x = 1; x < row.size(); ++x) {
      if (marks[begin + x - 1] == marks[begin + x]) continue;
      const Label value = marks[begin + x] == 0 ? row[x] : row[x - 1];
      is_one = is_one && value == first.value_or(value);
      first = value;
    }
    begin += row.size();
  });
  return is_one && first.has_value();
}

/// One of the six sides of a volume, and the rays from it, one from each of its voxels.
struct RaySide {
  std::size_t across;  ///< voxels along a ray
  std::ptrdiff_t step;
  std::array<std::size_t, 2> counts;
  std::array<std::size_t, 2> steps;
  std::size_t corner;  ///< first voxel of the first ray

  std::size_t ray(std::size_t u, std::size_t v) const {
    return corner + u * steps[0] + v * steps[1];
  }
  std::size_t at(std::size_t begin, std::size_t depth) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(begin) +
                                    step * static_cast<std::ptrdiff_t>(depth));
  }
};

RaySide ray_side(const VoxelCounts& counts, std::size_t axis, bool is_far) {
  const VoxelGrid grid(counts);
  const auto& [sizes, steps, voxels] = grid;
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const auto step = static_cast<std::ptrdiff_t>(steps[axis]);
  return {sizes[axis],
          is_far ? -step : step,
          {sizes[u], sizes[v]},
          {steps[u], steps[v]},
          is_far ? steps[axis] * (sizes[axis] - 1) : 0};
}

/// Returns the depth of the first material on each ray; `across` without any.
std::vector<std::size_t> depths_from(const RaySide& side, const std::vector<std::uint8_t>& mask) {
  std::vector<std::size_t> depths;
  for (std::size_t v = 0; v < side.counts[1]; ++v) {
    for (std::size_t u = 0; u < side.counts[0]; ++u) {
      const std::size_t begin = side.ray(u, v);
      std::size_t depth = 0;
      while (depth < side.across && mask[side.at(begin, depth)] == 0) ++depth;
      depths.push_back(depth);
    }
  }
  return depths;
}

/// Whether a side sees a smooth surface, as of a wall and not of many grains. A tenth of a ball is
/// as steep as `steep`, and a fortieth of a tube.
bool is_smooth(const RaySide& side, const std::vector<std::size_t>& depths) {
  constexpr std::size_t steep = 3;
  constexpr std::size_t rarest = 20;
  std::size_t pairs = 0;
  std::size_t rough = 0;
  const auto look = [&](std::size_t a, std::size_t b) {
    if (depths[a] == side.across || depths[b] == side.across) return;
    ++pairs;
    if (std::max(depths[a], depths[b]) - std::min(depths[a], depths[b]) > steep) ++rough;
  };
  for (std::size_t k = 0; k < depths.size(); ++k) {
    if (k % side.counts[0] > 0) look(k, k - 1);
    if (k >= side.counts[0]) look(k, k - side.counts[0]);
  }
  return 2 * pairs > depths.size() && rarest * rough < pairs;
}

/// Rays from one side to the first material.
struct SideView {
  RaySide side;
  std::vector<std::size_t> depths;
};

/// What some sides see, with a layer of voxels more at each side.
struct Views {
  FilterCounts counts;
  std::vector<std::uint8_t> rest;    ///< 0: before the first material, from one of the sides
  std::vector<std::uint8_t> behind;  ///< 1: on a ray of one, from its first material on
};

/// `seen`: whether each side counts.
Views views_of(const std::vector<SideView>& sides, const VoxelCounts& counts,
               const std::array<bool, 6>& seen) {
  Views views;
  views.counts = {counts[0] + 2, counts[1] + 2, counts[2] + 2};
  const VoxelGrid grid(counts);
  const VoxelGrid wider(views.counts);
  const auto padded = [&](std::size_t k) {
    const auto [x, y, z] = grid.place(k);
    return (z + 1) * wider.steps[2] + (y + 1) * wider.steps[1] + x + 1;
  };
  views.behind.assign(wider.voxels, 0);
  views.rest.assign(wider.voxels, 1);
  for (std::size_t face = 0; face < sides.size(); ++face) {
    if (!seen[face]) continue;
    const auto& [side, depths] = sides[face];
    const auto step = static_cast<std::ptrdiff_t>(wider.steps[face / 2]) * (side.step < 0 ? -1 : 1);
    for (std::size_t ray = 0; ray < depths.size(); ++ray) {
      if (depths[ray] == side.across) continue;
      // The layer is before the first voxel.
      auto place =
          static_cast<std::ptrdiff_t>(padded(side.ray(ray % side.counts[0], ray / side.counts[0])));
      place -= step;
      for (std::size_t depth = 0; depth <= side.across; ++depth, place += step) {
        if (depth <= depths[ray]) {
          views.rest[static_cast<std::size_t>(place)] = 0;
        } else {
          views.behind[static_cast<std::size_t>(place)] = 1;
        }
      }
    }
  }
  return views;
}

/// Calls take(voxel, place among views) for each voxel.
template <class Take>
void for_each_place(const VoxelCounts& counts, const Take& take) {
  const auto [width, rows, slices] = VoxelGrid(counts).sizes;
  std::size_t k = 0;
  for (std::size_t z = 1; z <= slices; ++z) {
    for (std::size_t y = 1; y <= rows; ++y) {
      const std::size_t begin = (z * (rows + 2) + y) * (width + 2) + 1;
      for (std::size_t x = 0; x < width; ++x) take(k++, begin + x);
    }
  }
}

/// Returns the share of material among the voxels behind, by their distance to what was before in
/// steps of `length`; -1 where there are none.
std::vector<double> shares_by_distance(const Views& views, const std::vector<std::uint8_t>& mask,
                                       const VoxelCounts& counts,
                                       const std::vector<float>& distances, double length) {
  std::vector<std::array<std::uint64_t, 2>> found;
  for_each_place(counts, [&](std::size_t k, std::size_t place) {
    if (views.behind[place] == 0 || views.rest[place] == 0) return;
    const auto bin = static_cast<std::size_t>(std::lround(distances[place] / length));
    if (bin >= found.size()) found.resize(bin + 1, {0, 0});
    ++found[bin][0];
    found[bin][1] += mask[k];
  });
  std::vector<double> shares;
  for (const auto& [all, material] : found) {
    shares.push_back(all == 0 ? -1.0 : static_cast<double>(material) / static_cast<double>(all));
  }
  return shares;
}

/// Returns the step at which a wall has ended: nearly all is material before it, and much less
/// there; 0: there is no wall.
std::size_t end_of_wall(const std::vector<double>& shares) {
  constexpr double nearly_all = 0.95;
  constexpr double much_less = 0.5;  // grains touch a wall at places, a matrix fills most
  constexpr std::size_t drop = 3;    // a wall is rough by a voxel
  std::size_t end = 1;
  while (end < shares.size() && shares[end] >= nearly_all) ++end;
  if (end < 3) return 0;  // by less, grains that are seen first have one thickness too
  for (std::size_t k = end; k < shares.size() && k < end + drop; ++k) {
    if (shares[k] >= 0.0 && shares[k] <= much_less) return k;
  }
  return 0;
}

/// Returns the wall that some sides see. `must_cross`: it goes from one side of the volume to the
/// opposite one.
ContainerWall wall_in(const Views& views, const std::vector<std::uint8_t>& mask,
                      const VoxelCounts& counts, const Vector3& spacing, bool must_cross,
                      const Execution& execution) {
  const std::vector<float> distances =
      distances_to_zero(views.rest, views.counts, {spacing[0], spacing[1], spacing[2]}, execution);
  const double length = spacing.maxCoeff();
  const std::size_t end = end_of_wall(shares_by_distance(views, mask, counts, distances, length));
  // A liquid or a resin that fills a part of the volume is thicker than a wall.
  constexpr double thickest = 1.0 / 3.0;  // of the volume
  const double extent =
      std::min({counts[0] * spacing[0], counts[1] * spacing[1], counts[2] * spacing[2]});
  if (end == 0 || static_cast<double>(end) * length > thickest * extent) return {};
  ContainerWall wall;
  wall.marks.assign(mask.size(), 0);
  std::uint64_t material = 0;
  std::array<std::array<bool, 2>, 3> reaches = {};
  const VoxelGrid grid(counts);
  for_each_place(counts, [&](std::size_t k, std::size_t place) {
    material += mask[k];
    if (distances[place] > (static_cast<double>(end) + 0.5) * length) return;
    wall.marks[k] = 1;
    if (mask[k] == 0) return;
    ++wall.voxels;
    const std::array<std::size_t, 3> at = grid.place(k);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] == 0) reaches[axis][0] = true;
      if (at[axis] + 1 == grid.sizes[axis]) reaches[axis][1] = true;
    }
  });
  const bool crosses = std::any_of(reaches.begin(), reaches.end(),
                                   [](const auto& ends) { return ends[0] && ends[1]; });
  const std::uint64_t held = material - wall.voxels;
  // A hollow grain lies within the volume and holds little.
  const bool is_hollow_grain = !crosses && (must_cross || 2 * held < wall.voxels);
  // The space between dark grains fills most of the volume.
  const bool is_space = 2 * wall.voxels > mask.size();
  if (held == 0 || is_hollow_grain || is_space) return {};
  return wall;
}

}  // namespace

std::vector<std::uint8_t> not_scanned(LabelVolume& scan, const Execution& execution) {
  const VoxelCounts& counts = scan.geometry().counts;
  const Corners corners = corners_of(scan, execution.part(0.0, 0.5));
  std::pair<Label, std::size_t> most = {0, 0};
  for (const auto& [value, count] : corners.values) {
    if (value != 0 && count > most.second) most = {value, count};
  }
  // A few slices at an end may be filled, or one side.
  const bool is_filled = 20 * most.second > corners.all;
  if (!is_filled && !corners.has_nan) return {};
  std::vector<std::uint8_t> nan;
  std::vector<std::uint8_t> filled;
  for_each_row(scan, execution.part(0.5, 0.9), "Reading the volume",
               [&](const std::vector<Label>& row) {
                 for (const Label value : row) {
                   if (corners.has_nan) nan.push_back(value == 0 ? 1 : 0);
                   if (is_filled) filled.push_back(value == most.first ? 1 : 0);
                 }
               });
  keep_connected_to_border(nan, counts, execution.part(0.9, 0.95));
  keep_connected_to_border(filled, counts, execution.part(0.95, 1.0));
  const auto count_of = [](const std::vector<std::uint8_t>& marks) {
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
  };
  constexpr std::size_t fewest = 200;  // of so many voxels one
  const std::size_t found = count_of(filled);
  if (found * fewest < filled.size() || found == filled.size() ||
      !leaves_a_convex_body(filled, counts) ||
      has_one_value_at_its_sides(scan, filled, execution.part(1.0, 1.0))) {
    filled.clear();
  }
  if (count_of(nan) == 0) return filled;
  for (std::size_t k = 0; k < filled.size(); ++k) nan[k] |= filled[k];
  return nan;
}

ContainerWall container_wall(const std::vector<std::uint8_t>& mask, const VoxelCounts& counts,
                             const Vector3& spacing, const Execution& execution) {
  std::vector<SideView> sides;
  std::array<bool, 6> smooth = {};
  for (std::size_t face = 0; face < 6; ++face) {
    const RaySide side = ray_side(counts, face / 2, face % 2 == 1);
    sides.push_back({side, depths_from(side, mask)});
    smooth[face] = is_smooth(side, sides.back().depths);
  }
  // All smooth sides; without those of one axis, because a few large grains look smooth through the
  // open ends of a tube; one alone, of a plate.
  std::vector<std::array<bool, 6>> choices = {smooth};
  for (std::size_t but = 0; but < 3; ++but) {
    choices.push_back(smooth);
    choices.back()[2 * but] = choices.back()[2 * but + 1] = false;
  }
  for (std::size_t face = 0; face < 6; ++face) {
    choices.emplace_back();
    choices.back().fill(false);
    choices.back()[face] = smooth[face];
  }
  for (std::size_t k = 0; k < choices.size(); ++k) {
    const auto end = choices.begin() + static_cast<std::ptrdiff_t>(k);
    const bool is_some = std::count(choices[k].begin(), choices[k].end(), true) > 0;
    if (!is_some || std::find(choices.begin(), end, choices[k]) != end) continue;
    ContainerWall wall =
        wall_in(views_of(sides, counts, choices[k]), mask, counts, spacing, k > 0, execution);
    if (wall.voxels > 0) return wall;
  }
  return {};
}

}  // namespace wscvt
