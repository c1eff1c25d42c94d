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

/// A setting that brings the remesh closer to the scan with the same number of nodes, which is what
/// a simulation pays for: tried to its end by `remesh_with`, once. None where it cannot be
/// remeshed, or costs more than the run, of which `run_work` is the work (see Execution::work).
/// Throws Error(Cancelled).
std::vector<SuggestedSetting> suggest_settings(const RemeshOptions& options, std::uint64_t run_work,
                                               const RemeshWith& remesh_with,
                                               const Execution& execution);

/// The opening of the first shrink-wrap, in %, with which a scan that was refused is remeshed to
/// the end: those of `first`, of twice as much and so on up to coarsest_tried_percent are tried.
/// None where none does. Each takes as long as the run that it advises. Throws Error(Cancelled).
std::optional<double> working_opening(RemeshOptions options, double first,
                                      const RemeshWith& remesh_with, const Execution& execution);

}  // namespace wscvt
