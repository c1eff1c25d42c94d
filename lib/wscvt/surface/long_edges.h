// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
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

/// Returns the numbers of the points in the order of a space-filling curve (Morton 1966):
/// neighbours in the order are neighbours in space. If a mesh is larger than the caches and its
/// vertices have this order in memory, passes over it are several times faster.
std::vector<std::int32_t> space_order(const std::vector<Vector3>& points);

/// Sorts the vertices of a mesh in the order of space, and its triangles by their first vertices.
/// Corners of a triangle keep their order. Returns the old number of each vertex.
std::vector<std::int32_t> order_in_space(std::vector<Vector3>& points,
                                         std::vector<Triangle>& triangles);

}  // namespace wscvt
