// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/convex/convex_parts.h"
#include "wscvt/base/execution.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Returns lines for a log: parts, distances, volume.
std::vector<std::string> parts_lines(const PartsResult& result);

/// Returns a JSON document; see report_json.
std::string parts_json(const PartsResult& result, const ReportOrigin& origin = {});

/// Returns CSV with a header and a row, like report_csv. The columns do not depend on the parts.
std::string parts_csv(const PartsResult& result, const ReportOrigin& origin = {});

/// Returns an HTML report: the grain, the parts, and the parts with their distance to the grain in
/// colour.
std::string parts_html(const PartsResult& result, const ReportOrigin& origin,
                       const Execution& execution);

/// Checks before the work that the report can be written, like check_remesh_report.
void check_parts_report(const std::string& path);

/// Writes the report in the format of the file's name, like write_report of a remesh.
void write_report(const std::string& path, const PartsResult& result, const ReportOrigin& origin,
                  const Execution& execution);

}  // namespace wscvt
