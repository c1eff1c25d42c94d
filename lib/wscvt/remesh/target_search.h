// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "wscvt/base/execution.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

/// Remeshes to a number of nodes.
using RemeshToCount = std::function<RemeshResult(int node_count, const Execution& execution)>;

/// Returns the remesh with the smallest number of nodes that meets the target or, if none does,
/// with the largest number tried; `search` says which (see smallest_node_count). Throws what
/// `remesh_to` throws, except for counts that cannot be remeshed, and Error(NumericalFailure) if
/// all counts fail.
RemeshResult remesh_to_target(const ErrorTarget& target, int first_count,
                              const RemeshToCount& remesh_to, const Execution& execution);

}  // namespace wscvt
