// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Vertices far from all their neighbours. Lengths.
struct StrayVertex {
  std::size_t count = 0;            ///< of such vertices
  double distance = 0.0;            ///< of the farthest one from its nearest neighbour; 0: none
  std::size_t vertex = 0;           ///< its index
  Vector3 place = Vector3::Zero();  ///< its position
  double usual = 0.0;  ///< median of the distance of the mesh's vertices from their middle
};

/// Finds vertices that lie so far from all their neighbours that they may be faults of a scan:
/// farther than 5 medians of the distance of the mesh's vertices from their middle; or farther than
/// a quarter of it and than twice the way round the vertex from neighbour to neighbour. Points need
/// not be welded. Indices and corners are valid and finite. Noise and voxels never move a vertex as
/// far.
StrayVertex find_stray_vertex(const IndexedMesh& mesh);

}  // namespace wscvt
