// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns for every half-edge (see half_edges.h) the next half-edge on its edge, in a ring: itself
/// on a boundary edge, the opposite half-edge on a manifold edge. If more than two faces meet, it
/// is the next higher half-edge, and after the last the first. The orientation of the faces does
/// not matter.
std::vector<std::int32_t> edge_rings(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
