// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// A level of grey values, and which side of it is material.
struct GreyLevel {
  double value = 0.0;
  double contrast = 0.0;  ///< between the phases beside the level; 0: unknown
  bool is_dark = false;   ///< the material is up to the level, not from it on
  int medians = 1;        ///< of 27 voxels that smoothed the grey values
};

/// The largest standard deviation of a blur that level_mask corrects; voxels.
inline constexpr double largest_blur = 1.5;

/// Returns the standard deviation of the blur at a level along an axis, in voxels, from neighbours
/// on either side of the level; 0 without any. `outside` as in level_mask.
double blur_at(const std::vector<std::uint16_t>& grey, const std::vector<std::uint8_t>& outside,
               const VoxelCounts& counts, const GreyLevel& level);

/// Returns 1 for each voxel of material among smoothed grey values, x fastest.
///
/// The blur of a scan and the median move the surface of a grain to its hollow side, by half of
/// their variance times the curvature: a ball of 8 voxels radius loses 6 % of its volume. Here the
/// grey values are averaged over 27 voxels, and the multiple of their Laplacian is taken away that
/// moves a curved edge back. The blur is measured: it is what neighbours across the level differ
/// by. A blur of more than `largest_blur` counts as this. Only voxels beside the level of the
/// averages change sides, so that noise makes no specks.
///
/// `outside`: 1 for voxels that were not scanned and are no material; empty: none. Memory is 9
/// bytes per voxel.
std::vector<std::uint8_t> level_mask(const std::vector<std::uint16_t>& grey,
                                     const std::vector<std::uint8_t>& outside,
                                     const VoxelCounts& counts, const GreyLevel& level,
                                     const Execution& execution);

}  // namespace wscvt
