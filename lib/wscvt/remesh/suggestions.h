// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

/// Remeshes the same scan with other options.
using RemeshWith =
    std::function<RemeshResult(const RemeshOptions& options, const Execution& execution)>;

/// Returns a setting that brings the remesh closer to the scan with the same number of nodes,
/// because a simulation pays for the nodes. `remesh_with` tries one setting completely. Empty if it
/// fails or costs more than the run, whose work is `run_work` (see Execution::work). Throws
/// Error(Cancelled).
std::vector<SuggestedSetting> suggest_settings(const RemeshOptions& options, std::uint64_t run_work,
                                               const RemeshWith& remesh_with,
                                               const Execution& execution);

/// Returns the opening of the first shrink-wrap, in %, with which a refused scan can be remeshed
/// completely. Tries `first`, twice as much and so on up to coarsest_tried_percent. Empty if all
/// fail. Each trial takes as long as the run that it suggests. Throws Error(Cancelled).
std::optional<double> working_opening(RemeshOptions options, double first,
                                      const RemeshWith& remesh_with, const Execution& execution);

}  // namespace wscvt
