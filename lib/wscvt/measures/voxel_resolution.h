// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

namespace wscvt {

/// One descriptor of a voxelised grain, with what its voxels did to it.
struct ResolvedValue {
  std::string key;         ///< as in list_descriptors
  double value = 0.0;      ///< of the grain as it is
  double coarse = 0.0;     ///< mean of the grain with voxels of twice the size
  double scatter = 0.0;    ///< standard deviation over the poses of the coarse grain
  double corrected = 0.0;  ///< without the bias of the voxels; NaN if not resolved
  double low = 0.0;        ///< ends of the interval of 95 %; NaN if not resolved
  double high = 0.0;

  bool is_resolved() const { return std::isfinite(corrected); }
};

/// What the voxels did to a grain's descriptors; the toolbox's measure_resolution fills it.
struct Resolution {
  double voxel_size = 0.0;          ///< length
  double voxels_across = 0.0;       ///< equivalent diameter over the size of a voxel
  std::vector<ResolvedValue> rows;  ///< one for each of list_descriptors
};

}  // namespace wscvt
