// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "wscvt/nodes/nodes_options.h"

namespace wscvt {

/// Looks for the smallest node count in [lower, upper] whose error is at most `target` (> 0).
///
/// From `start` the count grows, or shrinks, until it brackets the target; then the bracket closes
/// by interpolating log(error) over log(count), every third time by halving, to neighbouring counts
/// below 50 and to 2 % above. An error that wavers with the count is followed only so far: the
/// count returned meets the target, and the largest count tried below it does not. Throws
/// Error(InvalidInput) for a target that is not positive or limits out of order.
NodeCountSearch smallest_node_count(double target, int start, int lower, int upper,
                                    const std::function<double(int)>& error);

}  // namespace wscvt
