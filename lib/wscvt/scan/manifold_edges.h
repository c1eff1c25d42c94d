// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// What was done about edges on which more than two faces meet.
struct ManifoldRepair {
  std::size_t edges = 0;           ///< found
  std::size_t dropped_faces = 0;   ///< of flaps and inner walls that ended there
  double dropped_area = 0.0;       ///< length^2
  std::size_t added_vertices = 0;  ///< on edges that two sheets share from now on
};

/// Takes the surface apart into sheets at the edges where more than two faces meet, so that at most
/// two meet anywhere:
///
/// 1. The edges cut the surface into patches. A patch without which fewer edges are out of balance
///    (as many faces that look one way as the other) is a flap or a wall inside the body and is
///    dropped, the smallest first; the largest never is. A patch that balances more edges when
///    turned round is turned.
/// 2. The faces left on an edge, sorted by angle about it, are paired so that each pair has the
///    body between them: where two parts of a body touch in an edge they come apart. A face without
///    a partner is left with a boundary edge.
/// 3. Each pair after the first gets a vertex of its own on the edge, which cuts its faces in two.
///    No position changes.
///
/// `rings` as edge_rings makes them; they are no longer those of the mesh.
ManifoldRepair separate_sheets(IndexedMesh& mesh, const std::vector<std::int32_t>& rings);

}  // namespace wscvt
