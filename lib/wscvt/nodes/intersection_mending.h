// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/edit_mesh.h"

namespace wscvt {

/// What parting did.
struct PartingReport {
  std::size_t before = 0;  ///< pairs of triangles that met
  std::size_t after = 0;   ///< that still do
};

/// Parts triangles that meet: the nodes of a knot move outwards, where chords of both sheets of a
/// thin place cross, or towards the middles of their rings, where neighbours are folded, whichever
/// leaves fewer pairs. Nodes elsewhere stay. The number of pairs never grows.
PartingReport part_triangles(EditMesh& mesh, const Execution& execution);

}  // namespace wscvt
