// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/clump/clump.h"
#include "toolbox/clump/clump_options.h"
#include "wscvt/base/execution.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Every option of a clump with the name and value of the command line.
Json json_of(const ClumpOptions& options);

/// Returns the errors of the clump as lines of plain text for a log, at most 11. The reports have
/// its mass properties.
std::vector<std::string> clump_lines(const ClumpResult& clump);

/// Returns a JSON document with the spheres, like report_json. Fractions of the equivalent radius
/// are in %.
std::string clump_json(const ClumpResult& clump, const ReportOrigin& origin = {});

/// Returns CSV with a header and a row, like report_csv.
std::string clump_csv(const ClumpResult& clump, const ReportOrigin& origin = {});

/// Returns an HTML report, like report_html. Its pictures show the scan, the clump, and the clump
/// with its distance to the scan in colour. Throws Error(Cancelled).
std::string clump_html(const ClumpResult& clump, const ReportOrigin& origin,
                       const Execution& execution);

/// Like check_remesh_report.
void check_clump_report(const std::string& path);

/// Like write_report of a remesh.
void write_report(const std::string& path, const ClumpResult& clump, const ReportOrigin& origin,
                  const Execution& execution);

}  // namespace wscvt
