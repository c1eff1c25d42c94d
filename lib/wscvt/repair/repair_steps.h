// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

// The steps of check_mesh that change a scan, in their order.

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

/// Finds vertices of a closed component where the surface touches itself: more than one fan of
/// faces meets there. Gives every fan after the first a copy of the vertex. Returns the number of
/// added vertices. `rings` as edge_rings returns them; they refer to faces and corners, not
/// vertices, and stay valid. `of_face` and `component` as in Components.
std::size_t split_touching_vertices(IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                                    const std::vector<std::int32_t>& of_face,
                                    std::int32_t component, const Execution& execution);

/// Counts of fill_holes.
struct FilledHoles {
  std::size_t holes = 0;  ///< rims; none passes a vertex twice
  std::size_t faces = 0;
  double area = 0.0;    ///< of the faces added, length^2
  double widest = 0.0;  ///< largest 4 area / rim: the diameter of a round hole, length
};

/// Closes every hole of a consistently oriented surface with at most two faces per edge. A rim of
/// three edges gets a face. A longer rim gets the triangles between its vertices that CGAL finds
/// (Liepa 2003, "Filling holes in meshes", with the candidates of a Delaunay triangulation: the
/// smallest angles between faces, then the smallest area). If CGAL finds no triangles, or they need
/// an edge that the surface has elsewhere, the rim is joined to a new vertex at its centroid; every
/// edge then has two faces. New faces and vertices follow the old ones. `rings` as edge_rings
/// returns them; they are not valid afterwards.
FilledHoles fill_holes(IndexedMesh& mesh, const std::vector<std::int32_t>& rings);

}  // namespace wscvt
