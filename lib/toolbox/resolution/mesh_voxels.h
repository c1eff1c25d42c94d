// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "toolbox/volume/voxel_surface.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Where a body lies in a grid of voxels.
struct VoxelPose {
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Vector3 shift = Vector3::Zero();  ///< after the turn, in voxels
};

/// Returns the voxels whose centres are inside a closed outward mesh, in the order of their z, y
/// and x. The turned body is first moved so that its least coordinates are 0. `voxel_size` > 0 is a
/// length. Throws Error(InvalidInput) for more than 20,000 voxels along an axis.
std::vector<VoxelStretch> mesh_voxels(const IndexedMesh& mesh, double voxel_size,
                                      const VoxelPose& pose);

/// Returns the surface that label_grains.h makes of these voxels, with as many passes of smoothing.
/// One voxel is a `voxel_size`. Throws as smoothed_surface does; Error(InvalidInput) without
/// voxels.
IndexedMesh surface_of_voxels(const std::vector<VoxelStretch>& voxels, int passes,
                              double voxel_size);

/// Returns the voxels of which surface_of_voxels made a mesh, moved anywhere but not turned, with
/// as many passes; nothing for other meshes. A vertex is never more than half a voxel from its
/// corner of the lattice, so that the centres of the voxels stay inside.
std::optional<std::vector<VoxelStretch>> voxels_of_surface(const IndexedMesh& mesh, int passes,
                                                           double voxel_size);

}  // namespace wscvt
