// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A region that faces bound, within one piece: faces connected through edges.
struct MeshCell {
  std::int32_t piece = 0;
  double volume = 0.0;  ///< length^3; of the outside of a piece minus the sum of the others
  bool is_outside = false;
  /// Whether an odd number of surfaces lies between it and the outside. If that number depends on
  /// the way, walls are there once, and all regions but the outside are solid.
  bool is_solid = false;
  /// A solid region all of whose faces look into it, in a piece with walls that are there once: a
  /// body or a void, which the faces do not tell.
  bool may_be_void = false;
};

/// The regions that the faces of a mesh bound.
struct MeshCells {
  std::vector<Triangle> faces;       ///< each once, in the order of the mesh
  std::vector<std::int32_t> source;  ///< their indices in the mesh
  /// Of each face the first copy in the other direction, -1 if there is none. Such a wall belongs
  /// to both its sides: closed surfaces touch there.
  std::vector<std::int32_t> reverse;
  std::vector<MeshCell> list;  ///< in the order of their first sides
  /// The cells before and behind each face: 2 f the one its normal points into, 2 f + 1 the other.
  std::vector<std::int32_t> of_side;
  std::size_t pieces = 0;
  /// For every piece 1 if it has walls that are there once.
  std::vector<char> has_single_walls;
  /// For every piece a half-edge, 3 f + k, where faces lie on each other, so that its cells could
  /// not be told apart; -1 for the others.
  std::vector<std::int32_t> unclear;
  /// For every piece the first half-edge where faces lie on each other, also if its cells are
  /// closed without it; -1 for the others.
  std::vector<std::int32_t> lying;

  std::int32_t before(std::size_t face) const { return of_side[2 * face]; }
  std::int32_t behind(std::size_t face) const { return of_side[2 * face + 1]; }
};

/// Finds the regions by walking about each edge: of the faces on it, sorted by their angles, each
/// bounds a region together with the next. So a wall has two sides, whatever its direction, and
/// surfaces that touch in an edge are told apart. An edge with one face joins its two sides. Where
/// faces lie on each other, or cross a little, and all surfaces are closed and look outward, the
/// faces of each body are paired instead. Edges with faces in one direction are else left out; if a
/// region is not closed without them, its piece is unclear. `mesh` is welded, with faces of three
/// different corners.
MeshCells find_mesh_cells(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
