// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "wscvt/remesh/error_target.h"

namespace wscvt {

/// Finds the smallest node count in [lower, upper] whose error is at most `target` (> 0).
///
/// From `start` the count grows or shrinks until it brackets the target. The bracket then closes by
/// interpolating log(error) over log(count), every third time by halving, to neighbouring counts
/// below 50 and to 2 % above. If the error does not fall steadily with the count, the search still
/// ensures that the returned count meets the target and the largest smaller count tried does not.
/// Throws Error(InvalidInput) for a target that is not positive or limits out of order.
NodeCountSearch smallest_node_count(double target, int start, int lower, int upper,
                                    const std::function<double(int)>& error);

}  // namespace wscvt
