// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "wscvt/base/option.h"
#include "wscvt/measures/error_measure.h"
#include "wscvt/tessellation/seeding_options.h"

namespace wscvt {

/// Node count by error: the smallest N that meets it is looked for (see smallest_node_count).
struct ErrorTarget {
  ErrorMeasure measure = ErrorMeasure::Distance;
  double percent = 0.0;            ///< 0 to 100; 0: none, N is the options' node_count
  int largest_node_count = 20000;  ///< the search goes no further; 4 to 1000000
};

inline constexpr NumberOption<double> error_target_option = {
    "target",   "error target in %",
    0.0,        100.0,
    Ends::Both, "the smallest number of nodes with at most this error is looked for; 0: none"};
inline constexpr NumberOption<int> largest_node_count_option = {"largest",
                                                                "largest number of nodes to try",
                                                                node_count_option.minimum,
                                                                node_count_option.maximum,
                                                                Ends::Both,
                                                                "with an error target"};

/// One number of nodes that was tried.
struct NodeCountTrial {
  int node_count = 0;
  double error = 0.0;  ///< >= 0, any unit
};

/// What a search found.
struct NodeCountSearch {
  bool met = false;  ///< the target was reached within the limits
  int node_count =
      0;  ///< smallest count found to meet the target; the largest allowed if none does
  std::vector<NodeCountTrial> trials;  ///< in the order made
};

/// Looks for the smallest node count in [lower, upper] whose error is at most `target` (> 0).
///
/// From `start` the count grows, or shrinks, until it brackets the target; then the bracket closes
/// by interpolating log(error) over log(count), every third time by halving, to neighbouring counts
/// below 50 and to 2 % above. An error that wavers with the count is followed only so far: the
/// count returned meets the target, and the largest count tried below it does not. Throws
/// Error(InvalidInput) for a target that is not positive or limits out of order.
NodeCountSearch smallest_node_count(double target, int start, int lower, int upper,
                                    const std::function<double(int)>& error);

}  // namespace wscvt
