// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "wscvt/base/option.h"
#include "wscvt/sample/grain_table.h"

namespace wscvt {

/// Errors of a descriptor over a sample with one number of nodes, % of the scan's value.
struct LevelError {
  double median = 0.0;
  double percent_90 = 0.0;  ///< 90 % of the grains have a smaller error
  std::size_t count = 0;    ///< grains that have both values
};

/// Errors of one descriptor at each level.
struct DescriptorLevels {
  std::string name;  ///< "rms_distance", which is in % of the equivalent radius; then descriptors
  std::vector<LevelError> levels;
  /// Number of nodes from which on 90 % of the grains have errors below the mark: the line between
  /// two levels is straight on logarithmic axes. NaN if no level is enough.
  double nodes_needed = 0.0;
};

/// A sample remeshed with several numbers of nodes.
struct DetailLevels {
  double mark_percent = 0.0;
  std::vector<double> nodes;  ///< ascending
  std::vector<DescriptorLevels> rows;
};

inline constexpr NumberOption<double> mark_option = {
    "mark",
    "marked error",
    0.0,
    100.0,
    Ends::NotMinimum,
    "in %, of levels: the number of nodes is told from which on 90 % of the grains are below it"};

/// Errors of the remeshes in tables of shapes, one per number of nodes, in any order. Descriptors
/// of which an error in % says nothing are left out (DescriptorValue::on_ratio_scale). Throws
/// Error(InvalidInput) if a table lacks the columns of scan and remesh, or two have one number of
/// nodes.
DetailLevels measure_levels(const std::vector<GrainTable>& tables, double mark_percent);

}  // namespace wscvt
