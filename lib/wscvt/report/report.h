// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/report/remesh_result.h"
#include "wscvt/report/report_origin.h"

namespace wscvt {

/// The result as lines of plain text for a log: input counts and repairs, folded share, fit degree
/// and residual, iterations and why they stopped, N and faces, quality before and after, the table
/// descriptor / original / remesh / error %, warnings. The decimal sign is a point in every locale.
std::vector<std::string> report_lines(const RemeshResult& result);

/// The same as a JSON document (UTF-8, two-space indent, keys in a fixed order). Options have the
/// names and the values that one types for the program. Numbers that are not finite become null,
/// and so does what was not asked for or not told.
std::string report_json(const RemeshResult& result, const ReportOrigin& origin = {});

/// The report as CSV after RFC 4180: a header and one row. Every member of the JSON document that
/// is not in a list is a column, named by the path to it, joined with dots ("options.weighting"),
/// so the histories, the coarser levels, the node counts tried and the descriptors' names are left
/// out. Every report has the same columns, so that the rows of many remeshes make one table.
/// Numbers read back to the same bits; null is empty. Warnings stand in the last column.
std::string report_csv(const RemeshResult& result, const ReportOrigin& origin = {});

/// The same as a page for reading and printing (HTML), one file that refers to no other: pictures
/// of scan and remesh and of the distance between them, histograms, descriptors, every option as
/// one types it, the log; with an error target the error against the number of nodes. The scan is
/// the result's used_scan; without one (a surface from a formula) the page shows the remesh alone.
/// A page of a scan with a million faces takes 300 MB while it is made. Throws Error(Cancelled).
std::string report_html(const RemeshResult& result, const ReportOrigin& origin,
                        const Execution& execution);

}  // namespace wscvt
