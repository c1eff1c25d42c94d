// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Whether a closed mesh consists of voxel faces: every face is perpendicular to an axis, and there
/// are at least 4 planes along each axis and 18 in total, so that a box and simple parts do not
/// count. A ball with a radius of 3 voxels has 21 planes. The step may differ between the axes.
bool has_voxel_steps(const IndexedMesh& mesh);

/// Returns advice on such a mesh, called `name`.
std::string voxel_steps_advice(const std::string& name);

}  // namespace wscvt
