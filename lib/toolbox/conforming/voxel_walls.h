// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "toolbox/conforming/grain_voxels.h"

namespace wscvt {

/// A face of voxels between two grains, or a grain and the background: four vertices,
/// counter-clockwise seen from `outer`.
struct WallQuad {
  std::array<std::int32_t, 4> corners;
  std::int32_t inner;  ///< the larger grain
  std::int32_t outer;  ///< the smaller grain; -1: background
};

/// The faces between all grains, with common vertices.
struct VoxelWalls {
  std::vector<VoxelCounts> corners;  ///< of the lattice, at the vertices
  std::vector<WallQuad> quads;
};

/// Makes the walls. Grains that touch only in an edge or a corner, with background between them,
/// are apart: each has its own vertices there. If the grains are well-composed, each of them is
/// closed and manifold.
VoxelWalls voxel_walls(const GrainVoxels& voxels);

}  // namespace wscvt
