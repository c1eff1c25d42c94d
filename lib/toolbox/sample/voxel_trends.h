// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "toolbox/sample/grain_sample.h"
#include "toolbox/sample/sample_statistics.h"

namespace wscvt {

/// Rank correlations of a descriptor with the size of the grains: does a trend survive without the
/// voxels' error?
struct VoxelTrend {
  std::string name;       ///< of the descriptor, as in GrainSample
  Estimate raw;           ///< of all grains whose descriptor is resolved
  Estimate corrected;     ///< of the same grains, corrected
  Estimate trusted;       ///< corrected, of the grains of least_trusted_across voxels and more
  std::size_t count = 0;  ///< of grains whose descriptor is resolved
  std::size_t trusted_count = 0;  ///< of them, those of least_trusted_across voxels and more
};

/// Returns the trends of the sample's descriptors without a unit; empty if the size of the voxels
/// is not known.
std::vector<VoxelTrend> voxel_trends(const GrainSample& sample);

}  // namespace wscvt
