// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"

namespace wscvt {

// Filters of ITK on voxels in their order, x fastest. ITK brings an Eigen of its own, so that
// nothing of the library that includes Eigen comes in here. Without ITK they throw what
// require_filters throws. What ITK itself refuses becomes Error(NumericalFailure); memory,
// std::bad_alloc.

/// How many voxels there are along x, y and z.
using FilterCounts = std::array<std::int32_t, 3>;

/// Throws Error(InvalidInput) that says what to install, where the program was built without ITK.
void require_filters();

/// The median of each voxel and its 26 neighbours; beyond the border the values of the border.
std::vector<std::uint16_t> median_of(const std::vector<std::uint16_t>& grey,
                                     const FilterCounts& counts, const Execution& execution);

/// Voxels of 0 that hang together by faces and do not reach the border become 1; the others are 0
/// or 1 already.
void fill_holes(std::vector<std::uint8_t>& mask, const FilterCounts& counts,
                const Execution& execution);

/// The basins of the distance to the nearest voxel of 0, watershed by watershed: one for each
/// maximum that is at least `depth` above the passes to higher ones. Voxels of 1 get the number of
/// their basin, from 1; voxels of 0 get 0. `spacing` are the lengths of a voxel, `depth` is a
/// length. Where two parts of the mask do not touch they may have one number. On one thread.
std::vector<std::uint32_t> basins_of(const std::vector<std::uint8_t>& mask,
                                     const FilterCounts& counts,
                                     const std::array<double, 3>& spacing, double depth,
                                     const Execution& execution);

}  // namespace wscvt
