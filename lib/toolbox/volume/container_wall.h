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

}  // namespace wscvt
