// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Box with sides along the axes.
struct Box {
  Vector3 low = Vector3::Zero();
  Vector3 high = Vector3::Zero();
};

/// Box of all corners of the faces. A vertex of no face does not count: it may lie anywhere.
Box box_of_faces(const IndexedMesh& mesh, const Execution& execution);

/// Which points are the same.
struct Weld {
  /// For every vertex the one that takes its place, itself or an earlier one; empty when all stay.
  std::vector<std::int32_t> first;
  std::size_t welded = 0;  ///< vertices merged into another
};

/// Merges points that differ by at most `tolerance` (length, >= 0; 0: exact copies, where -0 equals
/// 0) in each coordinate. In their order, each point is merged into the earliest one kept that is
/// so near, or is kept: no two kept points are within the tolerance of each other, and none is
/// moved by more than it. Points outside of `box` (see box_of_faces), and those at no finite
/// position, are no corners of faces and are left alone.
Weld find_equal_points(const std::vector<Vector3>& points, const Box& box, double tolerance,
                       const Execution& execution);

}  // namespace wscvt
