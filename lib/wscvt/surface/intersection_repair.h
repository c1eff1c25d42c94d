// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {

/// Counts of part_triangles.
struct PartingReport {
  std::size_t before = 0;  ///< intersecting triangle pairs
  std::size_t after = 0;   ///< pairs that remain
};

/// Separates intersecting triangles. The nodes of a knot move outwards, for chords of both sheets
/// of a thin place, or towards the middles of their rings, for folded neighbours; the move that
/// leaves fewer pairs is used. Other nodes stay. The number of pairs never grows.
PartingReport part_triangles(EditMesh& mesh, const Execution& execution);

}  // namespace wscvt
