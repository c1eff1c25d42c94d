// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// The wall of a container in which grains were scanned.
struct ContainerWall {
  /// 1 for its voxels, those beside it and those outside of it, x fastest; empty: there is none.
  std::vector<std::uint8_t> marks;
  std::uint64_t voxels = 0;  ///< of material among them
};

/// Finds a tube, box, cup or plate among material. It is what is met first from sides of the volume
/// that see a smooth surface, has one thickness, and has void behind it. Grains that touch it are
/// parted from it at this thickness. `mask`: 1 for material, x fastest; void and what was not
/// scanned are 0. `spacing`: edge lengths of a voxel. Throws as basins_of.
ContainerWall container_wall(const std::vector<std::uint8_t>& mask, const VoxelCounts& counts,
                             const Vector3& spacing, const Execution& execution);

/// Returns 1 for each voxel that was not scanned, x fastest; empty if all were. Reads the volume,
/// which gives grey values, once or twice. Not scanned are, as far as they are connected to the
/// border by faces:
/// - voxels that are not a number;
/// - voxels of one value that fills most corners of the slices, if what they leave is a convex body
///   that reaches from one side of the volume to the opposite one, such as the cylinder of a
///   reconstruction. Void between grains leaves no convex body.
std::vector<std::uint8_t> not_scanned(LabelVolume& scan, const Execution& execution);

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
