// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// What was dropped with the faces that have two equal corners.
struct DegenerateFaces {
  std::size_t faces = 0;          ///< dropped
  std::size_t used_vertices = 0;  ///< different vertices that any face names, dropped ones included
};

/// Names the vertices of all faces by `first` (see Weld; empty: as they are) and drops the faces
/// with two equal corners. Dropping one opens nothing: its two other sides lie on each other. The
/// points stay where they are.
DegenerateFaces drop_degenerate_faces(IndexedMesh& mesh, const std::vector<std::int32_t>& first);

/// What was dropped of faces on the same three vertices; areas in length^2.
struct DuplicateFaces {
  std::size_t copies = 0;  ///< beside one that stayed
  double copied_area = 0.0;
  std::size_t folded = 0;  ///< none of which stayed
  double folded_area = 0.0;
};

/// Drops faces on the same three vertices: all but one when the faces around need it to close
/// (doubled faces), all when they close without it (a flap folded flat). Looks only at faces on
/// edges where more than two meet (see edge_rings). If any were dropped, the rings are no longer
/// those of the mesh.
DuplicateFaces drop_duplicate_faces(IndexedMesh& mesh, const std::vector<std::int32_t>& rings);

}  // namespace wscvt
