// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Counts of fill_holes.
struct FilledHoles {
  std::size_t holes = 0;  ///< rims; none passes a vertex twice
  std::size_t faces = 0;
  std::size_t vertices = 0;
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
