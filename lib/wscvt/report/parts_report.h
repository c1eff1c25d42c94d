// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/convex/convex_parts.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Convex parts beside the grain that they stand for.
struct PartsReport {
  ConvexParts parts;
  PartsMeasures measures;
  MassProperties mass;  ///< of the grain
  IndexedMesh grain;    ///< closed, outward; on a page
  std::vector<std::string> warnings;
};

/// Lines for a log: the parts, their distances, their volume.
std::vector<std::string> parts_lines(const PartsReport& report);

/// As a JSON document; see report_json.
std::string parts_json(const PartsReport& report, const ReportOrigin& origin = {});

/// As a page: the grain, the parts, and the parts with their distance to the grain in colour.
std::string parts_html(const PartsReport& report, const ReportOrigin& origin,
                       const Execution& execution);

/// Refuses before the work what could not be written after it, as check_remesh_report.
void check_parts_report(const std::string& path);

/// Writes the report in the format of its name, as that of a remesh.
void write_report(const std::string& path, const PartsReport& report, const ReportOrigin& origin,
                  const Execution& execution);

}  // namespace wscvt
