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

/// Settings that bring the remesh closer to the scan, each tried by `remesh_with`, not guessed:
/// first those that keep the number of nodes, which is what a simulation pays for. Settings that
/// cannot be remeshed are left out. Throws Error(Cancelled).
std::vector<SuggestedSetting> suggest_settings(const RemeshOptions& options,
                                               const RemeshWith& remesh_with,
                                               const Execution& execution);

}  // namespace wscvt
