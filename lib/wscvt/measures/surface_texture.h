// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// What a surface is like at the scale of its own faces.
enum class Texture {
  None,   ///< as smooth as its faces are small, or a coarse mesh
  Steps,  ///< the steps of voxels, hardly smoothed
  Noise   ///< noise of the vertices
};

struct SurfaceTexture {
  Texture kind = Texture::None;
  double excess = 0.0;  ///< of the area against a surface smoothed over about three faces; fraction
};

/// Looks for steps of voxels and for noise on a closed, outward mesh of a grain.
///
/// The area vectors of the faces are averaged eight times with those of the neighbours; the area
/// exceeds what the faces have along these means. Twenty scans have up to 3 %, marching cubes of a
/// mask from 6 % on at any resolution, noise of .5 % of the radius 5 to 33 % if the mesh is fine.
/// Above 5 % steps gather the normals along three orthogonal directions, and noise spreads them. A
/// coarse mesh of a convex or smooth body has few concave edges; one of a rough body loses more of
/// its area in the later averages. From 2.5 % on, a surface with 39 % of its angles concave is
/// noisy.
SurfaceTexture surface_texture(const IndexedMesh& mesh);

/// Returns which values of the grain `name` are false; empty without steps or noise.
std::string texture_sentence(const SurfaceTexture& texture, const std::string& name);

}  // namespace wscvt
