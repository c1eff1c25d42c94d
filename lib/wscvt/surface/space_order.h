// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the numbers of the points in the order of a space-filling curve (Morton 1966):
/// neighbours in the order are neighbours in space. If a mesh is larger than the caches and its
/// vertices have this order in memory, passes over it are several times faster.
std::vector<std::int32_t> space_order(const std::vector<Vector3>& points);

/// Sorts the vertices of a mesh in the order of space, and its triangles by their first vertices.
/// Corners of a triangle keep their order. Returns the old number of each vertex.
std::vector<std::int32_t> order_in_space(std::vector<Vector3>& points,
                                         std::vector<Triangle>& triangles);

}  // namespace wscvt
