// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"

namespace wscvt {

// Filters of ITK on voxels in their order, x fastest. ITK has its own Eigen, so this file must not
// include headers of the library that include Eigen. Without ITK the filters throw as
// require_filters does. Errors of ITK become Error(NumericalFailure); lack of memory,
// std::bad_alloc.

/// Numbers of voxels along x, y and z.
using FilterCounts = std::array<std::int32_t, 3>;

/// Throws Error(InvalidInput) that says what to install, if the program was built without ITK.
void require_filters();

/// Returns the median of each voxel and its 26 neighbours; values beyond the border equal the
/// border's.
std::vector<std::uint16_t> median_of(const std::vector<std::uint16_t>& grey,
                                     const FilterCounts& counts, const Execution& execution);

/// Sets voxels of 0 to 1 if they are not connected to the border by faces. All voxels are 0 or 1.
void fill_holes(std::vector<std::uint8_t>& mask, const FilterCounts& counts,
                const Execution& execution);

/// Returns the distance from each voxel of 1 to the nearest one of 0; both occur. `spacing`: edge
/// lengths of a voxel. Runs on one thread.
std::vector<float> distances_to_zero(const std::vector<std::uint8_t>& mask,
                                     const FilterCounts& counts,
                                     const std::array<double, 3>& spacing,
                                     const Execution& execution);

/// Basins of distances to the nearest voxel of 0.
struct Basins {
  std::vector<std::uint32_t> labels;     ///< from 1; 0 for voxels of 0
  std::vector<std::uint16_t> distances;  ///< in steps
  double step = 0.0;                     ///< a length
};

/// Returns the watershed basins of the distance to the nearest voxel of 0: one for each maximum
/// that is at least `depth` above the passes to higher maxima. `spacing`: edge lengths of a voxel;
/// `depth`: a length. Parts of the mask that do not touch may share a number. Runs on one thread.
Basins basins_of(const std::vector<std::uint8_t>& mask, const FilterCounts& counts,
                 const std::array<double, 3>& spacing, double depth, const Execution& execution);

}  // namespace wscvt
