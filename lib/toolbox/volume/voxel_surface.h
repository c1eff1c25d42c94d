// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"

namespace wscvt {

/// Voxels of one label along x: from `begin` to before `end`.
struct VoxelStretch {
  std::int32_t z;
  std::int32_t y;
  std::int32_t begin;
  std::int32_t end;
};

/// A face between a voxel of the label and another voxel: four vertices, counter-clockwise seen
/// from outside the label.
using VoxelFace = std::array<std::int32_t, 4>;

/// The outer surface of the largest piece of a label, made of voxel faces.
struct VoxelSurface {
  std::vector<VoxelCounts> corners;  ///< of the lattice, at the vertices; some repeatedly
  std::vector<VoxelFace> faces;
  std::size_t pieces = 0;         ///< of the label, connected by faces
  std::int64_t enclosed = 0;      ///< voxels inside the surface, pores filled
  std::int64_t pore_voxels = 0;   ///< in all pores of all pieces
  std::int64_t piece_voxels = 0;  ///< of all pieces, pores filled
};

/// Makes the surface of stretches in the order of their z, y and x. Voxels that touch only in an
/// edge or a corner are separate: each has its own vertices there. The faces about a vertex are
/// therefore always one ring, and two faces meet in each edge. Two edges may have the same two
/// vertices (smoothed_surface handles this). Memory is the surface and two slices of the label's
/// box.
///
/// No library is used: VTK and ITK are heavy (see vti_volume.cpp), and marching cubes of a label
/// lose an eighth of a voxel at every corner; these faces do not.
///
/// Throws Error(InvalidInput) if the surface has more faces than a mesh can number.
VoxelSurface voxel_surface(const std::vector<VoxelStretch>& stretches);

inline constexpr NumberOption<int> smoothing_option = {
    "smoothing", "number of smoothing passes", 0, 1000, Ends::Both, "0 leaves the voxels' faces"};

/// Returns the surface in the volume's coordinates, closed, outward and of one part. A low-pass
/// filter (Taubin 1995, A signal processing approach to fair surface design) of so many passes
/// smooths its steps. No vertex moves by more than half a voxel along each axis, so that thin parts
/// keep their two sides (Gibson 1998, Constrained elastic surface nets). Then the mesh is scaled
/// about its centroid to exactly the volume of the voxels inside the surface.
///
/// Each face gives two triangles, along the diagonal that is shorter in voxels. If two edges have
/// the same two vertices, each gets one more, in its middle. Throws Error(NumericalFailure) if too
/// little volume is left inside for scaling.
IndexedMesh smoothed_surface(const VoxelSurface& surface, int passes,
                             const VolumeGeometry& geometry);

}  // namespace wscvt
