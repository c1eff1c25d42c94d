// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "log_text.h"
#include "wscvt/remesh.h"

namespace wscvt::filter {

/// Returns a run's log, short and narrow enough for a host's panel: changes with one row per
/// measure, repairs, time, the `notes`, warnings, verdict. The report contains everything else.
std::vector<LogLine> log_lines(const RemeshResult& result, double seconds,
                               const std::vector<std::string>& notes = {});

}  // namespace wscvt::filter
