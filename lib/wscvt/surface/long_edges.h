// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {

/// A scan with split faces.
struct SplitScan {
  IndexedMesh mesh;
  std::vector<Vector3> normals;  ///< at the vertices, outward, unit
};

/// Splits edges longer than `length` > 0 at their midpoints, the longest first, until there are
/// none: the same surface with smaller faces, for a scan with fewer vertices than wanted nodes.
/// Halving the longest edge of a triangle bounds its angles from below (Rivara 1984, Int. J. Numer.
/// Methods Eng. 20, 745). The normal of a new vertex is the mean of its edge's ends. Neighbours in
/// space become neighbours in memory, in `mesh` and in the result.
/// Throws Error(InvalidInput) if more than `most` vertices would be needed.
SplitScan split_long_edges(EditMesh& mesh, double length, std::size_t most,
                           const Execution& execution);

}  // namespace wscvt
