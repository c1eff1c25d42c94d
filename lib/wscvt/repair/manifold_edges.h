// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Counts of the repairs of edges on which more than two faces meet.
struct ManifoldRepair {
  std::size_t edges = 0;           ///< found
  std::size_t dropped_faces = 0;   ///< of flaps and internal walls that ended there
  double dropped_area = 0.0;       ///< length^2
  std::size_t added_vertices = 0;  ///< on edges that two sheets now share
};

/// Separates the surface into sheets at the edges where more than two faces meet, so that no edge
/// has more than two faces:
///
/// 1. The edges cut the surface into patches. An edge is balanced if equally many faces use it in
///    each direction. If fewer edges are unbalanced without a patch, the patch is a flap or an
///    internal wall and is dropped. Small patches are dropped first, the largest never. A patch
///    that balances more edges when turned is turned.
/// 2. The remaining faces on an edge are sorted by angle and paired, with the body between the
///    faces of a pair. If two parts of a body touch in an edge, this separates them. A face without
///    a partner gets a boundary edge.
/// 3. Each pair after the first gets its own vertex on the edge, which splits its faces in two. No
///    position changes.
///
/// `rings` as edge_rings returns them; they are not valid afterwards.
ManifoldRepair separate_sheets(IndexedMesh& mesh, const std::vector<std::int32_t>& rings);

}  // namespace wscvt
