// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Joins parts of grains that a watershed has cut. `labels`: of basins, from 1, and 0 for void, x
/// fastest; changed to one label for the parts joined. `distances`: from each voxel to the
/// void, in any unit. The neck of two basins that touch by faces of voxels is the largest distance
/// at their common border. They are one grain if it is larger than `neck` times the inscribed
/// radius, the largest distance, of the smaller one. Wide necks are joined first.
void join_wide_necks(std::vector<std::uint32_t>& labels,
                     const std::vector<std::uint16_t>& distances, const VoxelCounts& counts,
                     double neck);

/// Moves the walls of touching grains to where the balls inscribed in both sides meet: gives each
/// voxel the label of the ball, around any voxel and up to the void, in which it is deepest, by the
/// power of a point. The valley of distances at a neck is flat across, so a watershed there follows
/// the errors of the distances, which tilt walls where voxels are long. Each grain hangs together
/// if it did. `labels`, `distances`: as above; `spacing`: edges of a voxel, in the unit of the
/// distances. The result does not depend on the number of threads.
void straighten_walls(std::vector<std::uint32_t>& labels,
                      const std::vector<std::uint16_t>& distances, const VoxelCounts& counts,
                      const Vector3& spacing, const Execution& execution);

}  // namespace wscvt
