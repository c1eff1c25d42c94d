// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/edit_mesh.h"

namespace wscvt {

/// Splits the edges longer than `length` at their middles, the longest first, until none is: the
/// same surface with smaller faces, for a scan that has fewer vertices than nodes are wanted.
/// Halving the longest edge of a triangle bounds its angles from below (Rivara 1984, Int. J. Numer.
/// Methods Eng. 20, 745). Returns the ends of the edge that each new vertex lies on, in order; they
/// may be new ones themselves. `length` > 0.
std::vector<std::array<std::int32_t, 2>> split_long_edges(EditMesh& mesh, double length,
                                                          const Execution& execution);

}  // namespace wscvt
