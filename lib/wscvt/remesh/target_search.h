// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "wscvt/base/execution.h"
#include "wscvt/remesh/error_target.h"
#include "wscvt/remesh/prepared_grain.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/remesh_result.h"

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

/// Returns the remesh of a grain with the smallest number tried that meets the target of the
/// options or, if none does, with the largest number tried; `search` says which (see
/// smallest_node_count). Throws what remesh_prepared throws, except for counts that cannot be
/// remeshed, and Error(NumericalFailure) if all counts fail.
RemeshResult remesh_to_target(const PreparedGrain& grain, const RemeshOptions& options,
                              const Execution& execution);

}  // namespace wscvt
