// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

/// Remeshes the same scan with other options.
using RemeshWith =
    std::function<RemeshResult(const RemeshOptions& options, const Execution& execution)>;

/// A setting that brings the remesh closer to the scan with the same number of nodes, which is what
/// a simulation pays for: tried to its end by `remesh_with`, once, so that it costs about as much
/// as the run. None where it cannot be remeshed. Throws Error(Cancelled).
std::vector<SuggestedSetting> suggest_settings(const RemeshOptions& options,
                                               const RemeshWith& remesh_with,
                                               const Execution& execution);

}  // namespace wscvt
