// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "log_text.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/remesh.h"

namespace wscvt::filter {

/// The log of a run, short enough for a host's panel: warnings, then what changed, one row a
/// measure, then what was repaired and the seconds. Everything else is in the report.
std::vector<LogLine> log_lines(const RemeshResult& result, double seconds);

/// Writes the report in the format of the file's extension; nothing for an empty name. `original`
/// is the mesh as it was given, of which an HTML report shows the edges; empty when there was none.
/// Throws Error(InputOutput) when the file cannot be written, Error(InvalidInput) for an extension
/// other than .html, .json or .csv. An HTML report also throws Error(InvalidInput) when there is no
/// QApplication to draw with, and what mesh_of_points and check_mesh throw for `original`.
void write_report(const RemeshResult& result, const IndexedMesh& original, const std::string& path);

}  // namespace wscvt::filter
