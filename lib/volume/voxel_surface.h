// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "volume/label_volume.h"

namespace wscvt {

/// Voxels of one label along x: from `begin` to before `end`.
struct VoxelStretch {
  std::int32_t z;
  std::int32_t y;
  std::int32_t begin;
  std::int32_t end;
};

/// A face between a voxel of the label and one that is not: four vertices, counter-clockwise seen
/// from outside the label.
using VoxelFace = std::array<std::int32_t, 4>;

/// The outer surface of the largest piece of a label, of faces of voxels.
struct VoxelSurface {
  std::vector<VoxelCounts>
      corners;  ///< of the lattice, where the vertices are; some more than once
  std::vector<VoxelFace> faces;
  std::size_t pieces = 0;         ///< of the label, which hang together by faces
  std::int64_t enclosed = 0;      ///< voxels inside the surface, pores filled
  std::int64_t pore_voxels = 0;   ///< in all pores of all pieces
  std::int64_t piece_voxels = 0;  ///< of all pieces, pores filled
};

/// Makes the surface of stretches that are in the order of their z, y and x. Voxels that touch in
/// an edge or a corner alone are apart: each has vertices of its own there, so the faces about a
/// vertex are one ring, and two faces meet in each edge, whatever the voxels. An edge's two
/// vertices may be those of another edge as well (see smoothed_surface, which sees to that). Memory
/// is that of the surface and of two slices of the label's box.
///
/// Not by a library: VTK and ITK are heavy (see vti_volume.cpp), and marching cubes of a
/// label lose an eighth of a voxel at every corner, which these faces do not.
///
/// Throws Error(InvalidInput) when the surface has more faces than a mesh can number.
VoxelSurface voxel_surface(const std::vector<VoxelStretch>& stretches);

}  // namespace wscvt
