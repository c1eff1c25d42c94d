// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// What was put into the holes.
struct FilledHoles {
  std::size_t holes = 0;  ///< rims that pass no vertex twice
  std::size_t faces = 0;
  std::size_t vertices = 0;
  double area = 0.0;    ///< of the faces added, length^2
  double widest = 0.0;  ///< largest 4 area / rim: the diameter of a round hole, length
};

/// Closes every hole of a consistently oriented surface on whose edges at most two faces meet. A
/// rim of three edges gets a face; a longer one the triangles between its vertices that CGAL finds
/// (Liepa 2003, "Filling holes in meshes", with the candidates of a Delaunay triangulation: the
/// smallest angles between faces, then the smallest area). Where those would need an edge that the
/// surface has elsewhere, or none are found, the rim is joined to a vertex at its centroid, which
/// always leaves two faces on every edge. New faces and vertices stand behind the old ones. `rings`
/// as edge_rings makes them; they are no longer those of the mesh.
FilledHoles fill_holes(IndexedMesh& mesh, const std::vector<std::int32_t>& rings);

}  // namespace wscvt
