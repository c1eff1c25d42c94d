// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

// Reports of a remesh and of measured grains: log lines, JSON, CSV and HTML, and their files.

/// Source and date of a report. The caller gives them, because the library reads no clock. Equal
/// input then gives equal bytes.
struct ReportOrigin {
  std::string source;  ///< name of the scan's file or layer; empty: left out
  std::string date;    ///< such as "2026-11-21"; empty: left out
};

/// Returns the program's name and version: "wscvt 1.0.0".
std::string made_by();

/// Returns "Made from scan.ply by wscvt 1.0.0 on 2026-11-21.", without empty fields.
std::string origin_sentence(const ReportOrigin& origin);

/// Returns the warnings of the result, and one of Sdq if it is not reliable: for whoever shows Sdq.
/// A remesh without the measure of Sdq is as good, so that its own warnings do not have this one.
std::vector<Sentence> report_warnings(const RemeshResult& result);

/// Returns lines of plain text for a log: input counts and repairs, overhang, fit degree and
/// residual, iterations and why they stopped, N and faces, quality before and after, the table
/// descriptor / scan / remesh / error %, report_warnings. The decimal sign is a point in every
/// locale.
std::vector<std::string> report_lines(const RemeshResult& result);

/// Returns these lines without the warnings, for who shows the warnings elsewhere.
std::vector<std::string> result_lines(const RemeshResult& result);

/// Returns the lines that a person reads first: scan, repairs, node count search, remesh, errors of
/// the paper's descriptors (volume, area, aspect ratio, sphericity, Sdq), the distances. Four lines
/// if nothing was repaired. Without warnings.
std::vector<std::string> summary_lines(const RemeshResult& result);

/// Returns what the first of one or more warnings begins with, up to a comma, a colon or its end,
/// and how many follow: "The remesh is not accurate and 2 more".
std::string named_warnings(const std::vector<Sentence>& warnings);

/// Returns one line for the end of a log: "1000 nodes, volume exact, area -0.323 %, rms 0.332 % of
/// the radius: good", or "...: look at: The remesh is not accurate" if there are warnings, as
/// named_warnings says. Up to "good" at most 80 columns for N up to a million.
std::string verdict_line(const RemeshResult& result);

/// Returns a JSON document (UTF-8, two-space indent, keys in a fixed order). Options have their
/// command-line names and values. Numbers that are not finite and results that were not requested
/// become null.
std::string report_json(const RemeshResult& result, const ReportOrigin& origin = {});

/// Returns CSV (RFC 4180) with a header and one row. Every member of the JSON document outside of
/// lists is a column, named by its path, joined with dots ("options.weighting"). Histories, coarser
/// levels, node counts tried and names of descriptors are lists and therefore omitted. All reports
/// have the same columns, so the rows of many remeshes form one table. Numbers read back to the
/// same bits; null is empty. The last column contains the warnings, with " | " between them.
std::string report_csv(const RemeshResult& result, const ReportOrigin& origin = {});

/// Returns an HTML report for reading and printing, one file without references to other files:
/// pictures of scan, remesh and the distance between them, histograms, descriptors, command-line
/// options, the log. With an error target also the error against the number of nodes. The scan is
/// the result's repaired_scan. Without it (a surface from a formula) the report shows only the
/// remesh. Needs 300 MB for a scan with a million faces. Throws Error(Cancelled).
std::string report_html(const RemeshResult& result, const ReportOrigin& origin,
                        const Execution& execution);

/// Returns a grain's measures as lines of plain text for a log: the grain, the table of
/// descriptors, the distances. The remarks are separate (see remarks). The decimal sign is a point
/// in every locale.
std::vector<std::string> descriptor_lines(const GrainMeasures& measures);

/// Returns the lines that a person reads first: the grain, the main descriptors, the distances. At
/// most 11 lines.
std::vector<std::string> summary_lines(const GrainMeasures& measures);

/// Returns the measures as a JSON document (UTF-8, two-space indent, keys in a fixed order).
/// Numbers that are not finite become null. The origin's source is ignored: the measures name their
/// grains.
std::string descriptor_json(const GrainMeasures& measures, const ReportOrigin& origin = {});

/// Returns the measures as CSV (RFC 4180) with a header and one row. Every member of the JSON
/// document outside of lists is a column, named by its path, joined with dots. Remarks are one
/// field. Measures with a reference or with the resolution have more columns.
std::string descriptor_csv(const GrainMeasures& measures, const ReportOrigin& origin = {});

/// Returns the measures as an HTML report, like report_html. Pictures and histograms show the grain
/// and, if present, the reference.
std::string descriptor_html(const GrainMeasures& measures, const ReportOrigin& origin,
                            const Execution& execution);

/// Format of a report's file: HTML for reading, JSON with everything, or a row of a CSV table.
enum class ReportFormat { Page, Document, Row };

/// The endings of names that decide it: ".html", ".json", ".csv".
const std::vector<std::string>& report_endings();

/// Returns the format by the ending of the file's name, in either case. Throws Error(InvalidInput)
/// for any other.
ReportFormat report_format(const std::string& path);

/// The forms of a report, each made when it is written.
struct ReportForms {
  std::function<std::string()> page;
  std::function<std::string()> document;
  std::function<std::string()> row;  ///< CSV with a header and a row
};

/// Writes the form for the file's name. Page and document replace the file, completely or not at
/// all; the row is appended to a table (see append_to_table). Throws the errors of report_format,
/// write_file and append_to_table.
void write_forms(const std::string& path, const ReportForms& forms);

/// Checks before the work that write_forms can write. `row` may have any numbers. Throws
/// Error(InvalidInput) for another ending or a table with other columns, Error(InputOutput) if the
/// file cannot be written.
void check_forms(const std::string& path, const std::function<std::string()>& row);

/// Whether a remesh's report of that name shows the scan. Only an HTML report does. Throws like
/// report_format.
bool shows_scan(const std::string& path);

/// Checks before the work that the report can be written. Throws as check_forms.
void check_remesh_report(const std::string& path);

/// Like check_remesh_report, for a report of descriptors, whose tables have more columns with a
/// reference or with the resolution.
void check_descriptor_report(const std::string& path, bool with_reference,
                             bool with_resolution = false);

/// Writes the report in the format of the file's name (see write_forms): report_html, report_json
/// or report_csv. Only the HTML report uses the result's repaired_scan. Throws the errors of these
/// functions.
void write_report(const std::string& path, const RemeshResult& result, const ReportOrigin& origin,
                  const Execution& execution);

/// Writes a report of descriptors, as above.
void write_report(const std::string& path, const GrainMeasures& measures,
                  const ReportOrigin& origin, const Execution& execution);

}  // namespace wscvt
