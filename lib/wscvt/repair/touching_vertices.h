// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Finds vertices of a closed component where the surface touches itself: more than one fan of
/// faces meets there. Gives every fan after the first a copy of the vertex. Returns the number of
/// added vertices. `rings` as edge_rings returns them; they refer to faces and corners, not
/// vertices, and stay valid. `of_face` and `component` as in Components.
std::size_t split_touching_vertices(IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                                    const std::vector<std::int32_t>& of_face,
                                    std::int32_t component, const Execution& execution);

}  // namespace wscvt
