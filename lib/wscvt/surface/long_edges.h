// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {

/// Splits edges longer than `length` > 0 at their midpoints, the longest first, until there are
/// none: the same surface with smaller faces, for a scan with fewer vertices than wanted nodes.
/// Halving the longest edge of a triangle bounds its angles from below (Rivara 1984, Int. J. Numer.
/// Methods Eng. 20, 745). Returns the ends of each new vertex's edge, in order; they may be new
/// vertices themselves.
/// Throws Error(InvalidInput) if more than `most` vertices would be needed.
std::vector<std::array<std::int32_t, 2>> split_long_edges(EditMesh& mesh, double length,
                                                          std::size_t most,
                                                          const Execution& execution);

}  // namespace wscvt
