// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "toolbox/conforming/wall_mesh.h"
#include "wscvt/base/execution.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

/// What finish_walls leaves.
struct FinishedWalls {
  std::vector<TrianglePair> pairs;  ///< triangles that intersect
  double volume_error = 0.0;        ///< largest, relative
};

/// Parts intersecting triangles and gives every grain its volume. Sheets of free surface move away
/// from each other, other nodes to the middle of their neighbours. Then the volumes are restored,
/// with smaller moves of the nodes that would make triangles intersect. `dense_edge`: of
/// the dense walls, such as a voxel's; length.
FinishedWalls finish_walls(WallMesh& mesh, const std::vector<double>& volumes, double dense_edge,
                           const Execution& execution);

}  // namespace wscvt
