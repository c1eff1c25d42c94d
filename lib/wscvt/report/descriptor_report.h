// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Appends lines to a log.
void append_lines(std::vector<std::string>& lines, std::vector<std::string> more);

/// One of the distances between a grain and its reference.
struct DistanceRow {
  std::string key;    ///< in files; never changes between versions
  std::string label;  ///< for people
  double value;       ///< length
};

/// Returns all distances; empty without a reference.
std::vector<DistanceRow> list_distances(const GrainMeasures& measures);

/// Describes a grain in one line: name, vertices, faces, genus.
std::string grain_line(const MeasuredGrain& grain);

/// Returns an aligned table of the distances, with % of the reference's equivalent radius. Empty
/// without a reference.
std::vector<std::string> distance_lines(const GrainMeasures& measures);

/// A body's mass properties and the heading of its column.
struct NamedMass {
  std::string name;
  MassProperties mass;
};

/// Returns rows of cells: mass properties at unit density, one column per body. The first row is
/// the head. The volume is in the table of descriptors.
std::vector<std::vector<std::string>> mass_rows(const std::vector<NamedMass>& bodies);

}  // namespace wscvt
