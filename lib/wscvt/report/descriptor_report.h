// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/report/report_origin.h"

namespace wscvt {

/// One of the distances between a grain and its reference.
struct DistanceRow {
  std::string key;    ///< in files; never changes between versions
  std::string label;  ///< for people
  double value;       ///< length
};

/// All of them; empty without a reference.
std::vector<DistanceRow> list_distances(const GrainMeasures& measures);

/// A grain in a line: name, vertices, faces, genus.
std::string grain_line(const MeasuredGrain& grain);

/// The distances as an aligned table, with % of the reference's equivalent radius; empty without a
/// reference.
std::vector<std::string> distance_lines(const GrainMeasures& measures);

/// A grain's measures as lines of plain text for a log: what was measured, the table of
/// descriptors, the distances; the remarks stand by themselves (see remarks). The decimal sign is a
/// point in every locale.
std::vector<std::string> descriptor_lines(const GrainMeasures& measures);

/// The same as a JSON document (UTF-8, two-space indent, keys in a fixed order). Numbers that are
/// not finite become null. The origin's source is not looked at: the measures name their grains.
std::string descriptor_json(const GrainMeasures& measures, const ReportOrigin& origin = {});

/// The same as CSV after RFC 4180: a header and one row, with every member of the JSON document
/// that is not in a list, under the path to it, joined with dots. Remarks are one field. Measures
/// with a reference have more columns than without.
std::string descriptor_csv(const GrainMeasures& measures, const ReportOrigin& origin = {});

/// The same as a page, as report_html; the pictures and histograms show the grain, and the
/// reference if there is one.
std::string descriptor_html(const GrainMeasures& measures, const ReportOrigin& origin,
                            const Execution& execution);

}  // namespace wscvt
