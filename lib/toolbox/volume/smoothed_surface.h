// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/voxel_surface.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"

namespace wscvt {

inline constexpr NumberOption<int> smoothing_option = {
    "smoothing", "number of smoothing passes", 0, 1000, Ends::Both, "0 leaves the voxels' faces"};

/// Returns the surface in the volume's coordinates, closed, outward and of one part. A low-pass
/// filter (Taubin 1995, A signal processing approach to fair surface design) of so many passes
/// smooths its steps. No vertex moves by more than half a voxel along each axis, so that thin parts
/// keep their two sides (Gibson 1998, Constrained elastic surface nets). Then the mesh is scaled
/// about its centroid to exactly the volume of the voxels inside the surface.
///
/// Each face gives two triangles, along the shorter diagonal. If two edges have the same two
/// vertices, each gets one more, in its middle. Throws Error(NumericalFailure) if too little volume
/// is left inside for scaling.
IndexedMesh smoothed_surface(const VoxelSurface& surface, int passes,
                             const VolumeGeometry& geometry);

}  // namespace wscvt
