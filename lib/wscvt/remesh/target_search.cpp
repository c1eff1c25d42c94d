// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/target_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

namespace {

/// Width at which the bracket is closed, as a fraction of the count; at least 1. Errors vary by as
/// much between neighbouring counts, and a tenth of it took twice as many remeshes.
constexpr double resolution = 0.02;

/// Largest factor between successive counts while the target is being bracketed.
constexpr double largest_stride = 8.0;

/// Returns the count at which an error that falls as 1 / count from `trial` meets the target, and a
/// little more, so that the next trial is likely on the other side.
double extrapolate(const NodeCountTrial& trial, double target) {
  const double ratio = trial.error / target;
  const double beyond = ratio > 1.0 ? 1.05 : 1.0 / 1.05;
  return trial.node_count * std::clamp(ratio * beyond, 1.0 / largest_stride, largest_stride);
}

int rounded(double count, int lower, int upper) {
  return static_cast<int>(std::lround(std::clamp<double>(count, lower, upper)));
}

}  // namespace

NodeCountSearch smallest_node_count(double target, int start, int lower, int upper,
                                    const std::function<double(int)>& error) {
  if (!(target > 0.0) || !std::isfinite(target)) {
    refuse("The error target is " + std::to_string(target) + ". Give a positive percentage.");
  }
  if (lower < 1 || lower > upper) {
    refuse("The limits of the node count are " + std::to_string(lower) + " and " +
           std::to_string(upper) + ". Give them in ascending order.");
  }
  NodeCountSearch search;
  const auto attempt = [&](int count) {
    search.trials.push_back({count, error(count)});
    return search.trials.back();
  };
  const auto meets = [&](const NodeCountTrial& trial) { return trial.error <= target; };

  NodeCountTrial trial = attempt(std::clamp(start, lower, upper));
  NodeCountTrial above = trial;
  NodeCountTrial below = trial;
  if (meets(trial)) {
    while (meets(below) && below.node_count > lower) {
      above = below;
      below = attempt(
          rounded(std::min(extrapolate(below, target), below.node_count - 1.0), lower, upper));
    }
    if (meets(below)) above = below;
  } else {
    while (!meets(above) && above.node_count < upper) {
      below = above;
      above = attempt(
          rounded(std::max(extrapolate(above, target), above.node_count + 1.0), lower, upper));
    }
  }
  search.met = meets(above);
  search.node_count = above.node_count;
  if (!search.met || meets(below)) return search;

  // Every third trial halves the bracket, for errors that do not follow a power of the count.
  constexpr int trials_a_halving = 3;
  for (int step = 1;
       above.node_count - below.node_count > std::max(1.0, resolution * above.node_count); ++step) {
    const double low = portable::log(below.node_count);
    const double high = portable::log(above.node_count);
    double count = portable::exp(0.5 * (low + high));
    const double span = portable::log(below.error / std::max(above.error, 1e-3 * target));
    if (step % trials_a_halving != 0 && std::isfinite(span) && span > 0.0) {
      const double share = portable::log(below.error / target) / span;
      count = portable::exp(low + share * (high - low));
      // First a little more, so that the target is met there; then a little less, so that it is
      // not. Two trials then close the bracket.
      count = (1.0 + 0.4 * resolution) * count < above.node_count - 1.0
                  ? (1.0 + 0.4 * resolution) * count
                  : (1.0 - 0.9 * resolution) * above.node_count;
    }
    trial = attempt(rounded(count, below.node_count + 1, above.node_count - 1));
    (meets(trial) ? above : below) = trial;
  }
  search.node_count = above.node_count;
  return search;
}

RemeshResult remesh_to_target(const PreparedGrain& grain, const RemeshOptions& options,
                              const Execution& execution) {
  const ErrorTarget& target = options.target;
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
      result = remesh_prepared(grain, options, node_count, execution.part(begin, end));
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
  NodeCountSearch search =
      smallest_node_count(target.percent, options.node_count, node_count_option.minimum,
                          target.largest_node_count, error);
  if (best.mesh.points.empty()) {
    throw Error(ErrorCode::NumericalFailure,
                "No tested node count could be remeshed. Allow more nodes.");
  }
  best.search = std::move(search);
  return best;
}

}  // namespace wscvt
