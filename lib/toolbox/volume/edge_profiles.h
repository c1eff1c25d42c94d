// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "toolbox/volume/edge_steps.h"
#include "toolbox/volume/label_volume.h"

namespace wscvt {

/// Grey values with the material by one level for all.
struct LevelledVolume {
  const std::vector<std::uint16_t>& grey;     ///< smoothed, x fastest
  const std::vector<std::uint8_t>& mask;      ///< the material
  const std::vector<std::uint8_t>& left_out;  ///< 1: neither void nor material; empty: none
  VoxelCounts counts;
  std::array<double, 3> spacing;  ///< edges of a voxel
  double level = 0.0;
};

/// Fits one and two blurred steps to the mean grey values along lines across the surface of each
/// grain, from 5 voxels outside to 6 inside. Sets the `plateaus` of grains that turn back below an
/// outer layer to that of the layer. Returns the steps of all grains that go on, and of all that
/// turn back, as they are on the average; grey values as in `scan`, which is not smoothed.
/// `labels`: of the grains, 0 between them; `plateaus`: one for each label; `is_dark`: the material
/// is darker than the void.
std::vector<EdgeSteps> use_layers(const LevelledVolume& volume,
                                  const std::vector<std::uint16_t>& scan,
                                  const std::vector<std::uint32_t>& labels, bool is_dark,
                                  std::vector<double>& plateaus);

}  // namespace wscvt
