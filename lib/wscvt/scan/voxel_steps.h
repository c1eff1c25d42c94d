// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Whether a closed mesh is made of the faces of voxels: every face lies across an axis, in at
/// least 4 planes along each axis and 18 in all, so that a box and simple parts are none. A ball of
/// 3 voxels' radius has 21. The step need not be the same along the axes.
bool has_voxel_steps(const IndexedMesh& mesh);

/// What to know of such a mesh, called `name`, and what to do.
std::string voxel_steps_advice(const std::string& name);

}  // namespace wscvt
