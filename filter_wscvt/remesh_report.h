// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "log_text.h"
#include "wscvt/remesh.h"

namespace wscvt::filter {

/// The log of a run, short and narrow enough for a host's panel: what changed, one row per measure,
/// what was repaired, the time, then the warnings. Everything else is in the report.
std::vector<LogLine> log_lines(const RemeshResult& result, double seconds);

}  // namespace wscvt::filter
