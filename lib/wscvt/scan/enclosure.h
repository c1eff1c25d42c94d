// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// For every point 1 when it lies inside the closed oriented mesh, that is, when the mesh winds
/// about it; points on the surface go either way. Takes time for the faces once and for the faces
/// over each point, not for points times faces.
std::vector<char> are_inside(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                             const Execution& execution);

}  // namespace wscvt
