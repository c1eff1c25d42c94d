// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "toolbox/sample/grain_table.h"
#include "wscvt/base/option.h"

namespace wscvt {

/// Absolute errors of one kind over a sample with one number of nodes, in %.
struct LevelError {
  double median = 0.0;
  double percent_90 = 0.0;  ///< 90 % of the grains have a smaller error
  std::size_t count = 0;    ///< grains that have the error
};

/// Errors of one kind at each level: distances and contacts in % of the equivalent radius, normals
/// of contacts in degrees, descriptors in % of the scan's value.
struct DescriptorLevels {
  std::string name;  ///< "rms_distance"; as the table's columns of contacts; descriptors
  std::vector<LevelError> levels;
  /// Smallest number of nodes from which on 90 % of the grains have errors below the mark,
  /// interpolated linearly on logarithmic axes between two levels. NaN if no level is enough, and
  /// for degrees, because the mark is in %.
  double nodes_needed = 0.0;
  std::string unit = "%";  ///< or "degrees"
};

/// A sample remeshed with several numbers of nodes.
struct DetailLevels {
  double mark_percent = 0.0;
  std::vector<double> nodes;  ///< ascending
  std::vector<DescriptorLevels> rows;
};

inline constexpr double usual_mark_percent = 1.0;
inline constexpr NumberOption<double> mark_option = {
    "max-error",
    "allowed error",
    0.0,
    100.0,
    Ends::NotMinimum,
    "in %. With several numbers of nodes, report the number from which 90 % of the grains have "
    "less error"};

/// Computes errors of the remeshes from tables of shapes, one per number of nodes, in any order.
/// Leaves out errors for which a table lacks a column, and descriptors for which an error in % has
/// no meaning (DescriptorValue::on_ratio_scale). Throws Error(InvalidInput) if a table has no
/// column "nodes" or two have one number of nodes.
DetailLevels measure_levels(const std::vector<GrainTable>& tables, double mark_percent);

}  // namespace wscvt
