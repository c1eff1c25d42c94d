// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Box with sides along the axes.
using Box = Eigen::AlignedBox3d;

/// The result of find_equal_points.
struct Weld {
  /// For every vertex its replacement: itself or an earlier vertex. Empty if all stay.
  std::vector<std::int32_t> first;
  std::size_t welded = 0;  ///< vertices merged into another
};

/// Merges points that differ by at most `tolerance` in each coordinate (length, >= 0; 0: exact
/// copies; -0 equals 0). In their order, each point is kept or merged into the earliest kept point
/// within the tolerance. No two kept points are then within the tolerance, and no point moves by
/// more than it. Leaves points outside `box` (see box_of_faces) and points that are not finite
/// unchanged; they are no corners of faces.
Weld find_equal_points(const std::vector<Vector3>& points, const Box& box, double tolerance,
                       const Execution& execution);

/// Vertices along open edges that are nearly equal.
struct SeamWeld {
  Weld weld;              ///< empty if there are none
  double distance = 0.0;  ///< largest of a merged vertex from its replacement, length
};

/// Merges vertices of open edges that differ by at most 1e-6 of `size` (the box's diagonal; more
/// for wider seams) in each coordinate, and at most a tenth of the mean open edge, if that closes
/// at least half of the open edges: programs that round coordinates, or compute a corner once for
/// each face, leave such seams. `rings` as edge_rings returns them.
SeamWeld find_seams(const IndexedMesh& mesh, const std::vector<std::int32_t>& rings, double size,
                    const Execution& execution);

}  // namespace wscvt
