// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Which points are the same.
struct Weld {
  /// For every vertex the first one at the same position; empty when all positions differ.
  std::vector<std::int32_t> first;
  std::size_t welded = 0;  ///< vertices merged into another
};

/// Finds the points that equal an earlier one. -0 equals 0. All coordinates must be finite.
Weld find_equal_points(const std::vector<Vector3>& points, const Execution& execution);

}  // namespace wscvt
