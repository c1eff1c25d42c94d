// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/label_volume.h"

namespace wscvt {

/// Grey values of the void and of the phases of material, the nearest to the void first. All are
/// brighter than the void, or all darker.
struct Phases {
  double space = 0.0;
  std::vector<double> materials;
};

/// Contrast of the values that even_contrast returns.
inline constexpr std::uint16_t even_full = 1000;

/// Returns grey values in which the void is 0 and each grain is `even_full`, so that the surface of
/// each is at half of this. With one level for all, grains brighter than others come out too large:
/// the level is in the outer part of their blurred edge.
///
/// `grey`: smoothed, x fastest. `mask`: the material by one level for all. `left_out`: 1 for voxels
/// that are neither void nor material; empty: none. `basins`: of the mask with its holes filled,
/// with distances to the void. The grey value of a basin is that of a shell below its surface, in
/// the phase that is nearest to the void there: not that of an inclusion. That of the void is
/// measured away from grains. `voxel`: edge of a voxel, a length. Only voxels near the surface of
/// the mask change sides.
std::vector<std::uint16_t> even_contrast(const std::vector<std::uint16_t>& grey,
                                         const std::vector<std::uint8_t>& mask,
                                         const std::vector<std::uint8_t>& left_out, Basins basins,
                                         const VoxelCounts& counts, double voxel, Phases phases);

}  // namespace wscvt
