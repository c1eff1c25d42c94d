// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns for every point 1 if it lies inside the closed oriented mesh (its winding number is not
/// 0). For points on the surface either result is possible. Faster than points times faces: it
/// visits the faces once, and for each point only the faces over it.
std::vector<char> are_inside(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                             const Execution& execution);

}  // namespace wscvt
