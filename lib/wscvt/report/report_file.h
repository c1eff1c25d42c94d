// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/report/remesh_result.h"
#include "wscvt/report/report_origin.h"
#include "wscvt/report/sample_summary.h"

namespace wscvt {

/// What a report's file becomes: a page for reading, everything for programs, or a row of a table.
enum class ReportFormat { Page, Document, Row };

/// The endings of names that decide it: ".html", ".json", ".csv".
const std::vector<std::string>& report_endings();

/// By the ending of the file's name, in either case. Throws Error(InvalidInput) for any other.
ReportFormat report_format(const std::string& path);

/// Whether a remesh's report of that name shows the scan: a page does. Throws as report_format.
bool shows_scan(const std::string& path);

/// Refuses before the work what could not be written after it: another ending or a table with other
/// columns (InvalidInput), and a place that cannot be written to (InputOutput).
void check_remesh_report(const std::string& path);

/// The same for a report of descriptors, whose tables have more columns with a reference.
void check_descriptor_report(const std::string& path, bool with_reference);

/// Writes the report in the format of its name: report_html and report_json whole or not at all in
/// the place of what was there, report_csv as a row more of a table (see append_to_table). A
/// page alone looks at the result's used_scan. Throws Error as those do.
void write_report(const std::string& path, const RemeshResult& result, const ReportOrigin& origin,
                  const Execution& execution);

/// The same for descriptors.
void write_report(const std::string& path, const GrainMeasures& measures,
                  const ReportOrigin& origin, const Execution& execution);

/// Writes the summary as a page or as JSON, by the ending of the name. Throws Error: InvalidInput
/// for another ending, InputOutput.
void write_summary(const std::string& path, const SampleSummary& summary);

/// Refuses before the work what write_summary would refuse after it.
void check_summary(const std::string& path);

}  // namespace wscvt
