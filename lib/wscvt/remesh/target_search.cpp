// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/target_search.h"

#include <cmath>
#include <limits>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/remesh/node_count_search.h"

namespace wscvt {

RemeshResult remesh_to_target(const ErrorTarget& target, int first_count,
                              const RemeshToCount& remesh_to, const Execution& execution) {
  // The result with the smallest node count that met the target, or with the largest tried.
  RemeshResult best;
  bool best_meets = false;
  int trials = 0;
  const auto error = [&](int node_count) {
    // The number of trials is unknown; about ten are usual.
    const double begin = 1.0 - portable::pow(0.85, trials);
    const double end = 1.0 - portable::pow(0.85, ++trials);
    RemeshResult result;
    try {
      result = remesh_to(node_count, execution.part(begin, end));
    } catch (const Error& failure) {
      // The nodes are too few to surround the centre. Deeper stages detect it, and it is rare.
      if (failure.code() != ErrorCode::NumericalFailure) throw;
      return std::numeric_limits<double>::infinity();
    }
    const double percent_off = error_percent(result, target.measure);
    const bool meets = percent_off <= target.percent;
    const int best_count = static_cast<int>(best.mesh.points.size());
    if (meets ? !best_meets || node_count < best_count : !best_meets && node_count > best_count) {
      best = std::move(result);
      best_meets = meets;
    }
    return percent_off;
  };
  NodeCountSearch search = smallest_node_count(
      target.percent, first_count, node_count_option.minimum, target.largest_node_count, error);
  if (best.mesh.points.empty()) {
    throw Error(ErrorCode::NumericalFailure,
                "No tested node count could be remeshed. Allow more nodes.");
  }
  best.search = std::move(search);
  return best;
}

}  // namespace wscvt
