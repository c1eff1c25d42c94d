// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Where more than one fan of faces of a closed component meets in a vertex, that is, where the
/// surface touches itself in a point, gives every fan after the first a copy of the vertex. Returns
/// how many vertices were added. `rings` as edge_rings makes them; they name faces and corners, not
/// vertices, and stay right. `of_face` and `component` as in Components.
std::size_t split_touching_vertices(IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                                    const std::vector<std::int32_t>& of_face,
                                    std::int32_t component, const Execution& execution);

}  // namespace wscvt
