// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// For every half-edge (see half_edges.h) the next one on the same edge, in a ring: itself on a
/// boundary edge, the opposite one on a manifold edge, the next higher (after the last, the first)
/// where more than two faces meet. Which way round the faces are listed does not matter.
std::vector<std::int32_t> edge_rings(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
