// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Counts of drop_degenerate_faces.
struct DegenerateFaces {
  std::size_t faces = 0;          ///< dropped
  std::size_t used_vertices = 0;  ///< different vertices of all faces, dropped faces included
};

/// Replaces the vertices of all faces by `first` (see Weld; empty: no change) and drops the faces
/// with two equal corners. This opens no hole, because the face's two other sides coincide. The
/// points do not move.
DegenerateFaces drop_degenerate_faces(IndexedMesh& mesh, const std::vector<std::int32_t>& first);

/// Counts of dropped faces with equal vertices; areas in length^2.
struct DuplicateFaces {
  std::size_t copies = 0;  ///< dropped copies of a face that stayed
  double copied_area = 0.0;
  std::size_t folded = 0;  ///< faces of which no copy stayed
  double folded_area = 0.0;
};

/// Drops faces with the same three vertices. Keeps one if the surrounding faces need it to be
/// closed (doubled faces). Drops all if the surface is closed without them (back-to-back faces).
/// Checks only faces on edges where more than two faces meet (see edge_rings). If any face was
/// dropped, `rings` are no longer valid.
DuplicateFaces drop_duplicate_faces(IndexedMesh& mesh, const std::vector<std::int32_t>& rings);

}  // namespace wscvt
