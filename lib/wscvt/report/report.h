// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

// Reports of a remesh and of measured grains: as lines, JSON, CSV and pages, and files of them.

/// Source and date of a report. The caller gives them, because the library
/// looks at no clock, so that the same work gives the same bytes.
struct ReportOrigin {
  std::string source;  ///< name of the scan's file or layer; empty: left out
  std::string date;    ///< such as "2026-11-21"; empty: left out
};

/// Returns the program's name and version: "wscvt 1.0.0".
std::string made_by();

/// Returns "Made from scan.ply by wscvt 1.0.0 on 2026-11-21.", without empty fields.
std::string origin_sentence(const ReportOrigin& origin);

/// The result as lines of plain text for a log: input counts and repairs, overhang, fit degree
/// and residual, iterations and why they stopped, N and faces, quality before and after, the table
/// descriptor / scan / remesh / error %, warnings. The decimal sign is a point in every locale.
std::vector<std::string> report_lines(const RemeshResult& result);

/// The result as a JSON document (UTF-8, two-space indent, keys in a fixed order). Options have the
/// names and the values that one types for the program. Numbers that are not finite become null,
/// and so does what was not requested.
std::string report_json(const RemeshResult& result, const ReportOrigin& origin = {});

/// The report as CSV after RFC 4180: a header and one row. Every member of the JSON document that
/// is not in a list is a column, named by the path to it, joined with dots ("options.weighting"),
/// so the histories, the coarser levels, the node counts tried and the descriptors' names are left
/// out. Every report has the same columns, so that the rows of many remeshes make one table.
/// Numbers read back to the same bits; null is empty. Warnings stand in the last column.
std::string report_csv(const RemeshResult& result, const ReportOrigin& origin = {});

/// The result as an HTML report for reading and printing, one file that refers to no other:
/// pictures of scan and remesh and of the distance between them, histograms, descriptors, every
/// option as one types it, the log; with an error target the error against the number of nodes. The
/// scan is the result's repaired_scan; without one (a surface from a formula) the page shows the
/// remesh alone. A page of a scan with a million faces takes 300 MB while it is made. Throws
/// Error(Cancelled).
std::string report_html(const RemeshResult& result, const ReportOrigin& origin,
                        const Execution& execution);

/// A grain's measures as lines of plain text for a log: what was measured, the table of
/// descriptors, the distances; the remarks stand by themselves (see remarks). The decimal sign is a
/// point in every locale.
std::vector<std::string> descriptor_lines(const GrainMeasures& measures);

/// The measures as a JSON document (UTF-8, two-space indent, keys in a fixed order). Numbers that
/// are not finite become null. The origin's source is not looked at: the measures name their
/// grains.
std::string descriptor_json(const GrainMeasures& measures, const ReportOrigin& origin = {});

/// The measures as CSV after RFC 4180: a header and one row, with every member of the JSON document
/// that is not in a list, under the path to it, joined with dots. Remarks are one field. Measures
/// with a reference have more columns than without.
std::string descriptor_csv(const GrainMeasures& measures, const ReportOrigin& origin = {});

/// The measures as an HTML report, like report_html; the pictures and histograms show the grain,
/// and the reference if there is one.
std::string descriptor_html(const GrainMeasures& measures, const ReportOrigin& origin,
                            const Execution& execution);

/// Format of a report's file: HTML for reading, JSON with everything, or a row of a CSV table.
enum class ReportFormat { Page, Document, Row };

/// The endings of names that decide it: ".html", ".json", ".csv".
const std::vector<std::string>& report_endings();

/// Returns the format by the ending of the file's name, in either case. Throws Error(InvalidInput)
/// for any other.
ReportFormat report_format(const std::string& path);

/// Whether a remesh's report of that name shows the scan: a page does. Throws as report_format.
bool shows_scan(const std::string& path);

/// Refuses before the work what could not be written after it: another ending or a table with other
/// columns (InvalidInput), and a place that cannot be written to (InputOutput).
void check_remesh_report(const std::string& path);

/// Like check_remesh_report, for a report of descriptors, whose tables have more columns with a
/// reference.
void check_descriptor_report(const std::string& path, bool with_reference);

/// Writes the report in the format of its name: report_html and report_json whole or not at all in
/// the place of what was there, report_csv as a row more of a table (see append_to_table). A
/// page alone looks at the result's repaired_scan. Throws Error as those do.
void write_report(const std::string& path, const RemeshResult& result, const ReportOrigin& origin,
                  const Execution& execution);

/// Writes a report of descriptors, as above.
void write_report(const std::string& path, const GrainMeasures& measures,
                  const ReportOrigin& origin, const Execution& execution);

}  // namespace wscvt
