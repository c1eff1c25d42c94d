// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/convex/parts.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Lines for a log: the parts, their distances, their volume.
std::vector<std::string> parts_lines(const PartsResult& result);

/// As a JSON document; see report_json.
std::string parts_json(const PartsResult& result, const ReportOrigin& origin = {});

/// As a page: the grain, the parts, and the parts with their distance to the grain in colour.
std::string parts_html(const PartsResult& result, const ReportOrigin& origin,
                       const Execution& execution);

/// Refuses before the work what could not be written after it, as check_remesh_report.
void check_parts_report(const std::string& path);

/// Writes the report in the format of its name, as that of a remesh.
void write_report(const std::string& path, const PartsResult& result, const ReportOrigin& origin,
                  const Execution& execution);

}  // namespace wscvt
