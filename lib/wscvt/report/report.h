// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/report/remesh_result.h"

namespace wscvt {

/// The result as lines of plain text for a log: input counts and repairs, folded share, fit degree
/// and residual, iterations and why they stopped, N and faces, quality before and after, the table
/// descriptor / original / remesh / error %, warnings. The decimal sign is a point in every locale.
std::vector<std::string> report_lines(const RemeshResult& result);

/// The same as a JSON document (UTF-8, two-space indent, keys in a fixed order). Options have the
/// names and the values that one types for the program. Numbers that are not finite become null,
/// and so does what was not asked for.
std::string report_json(const RemeshResult& result);

/// The same as CSV after RFC 4180: a header and one row. Every member of the JSON document that is
/// not in a list is a column, named by the path to it, joined with dots ("options.weighting"), so
/// the histories, the coarser levels, the node counts tried and the descriptors' names are left
/// out. Every report has the same columns, so that the rows of many remeshes make one table.
/// Numbers read back to the same bits; null is empty. Warnings stand in the last column.
std::string report_csv(const RemeshResult& result);

}  // namespace wscvt
