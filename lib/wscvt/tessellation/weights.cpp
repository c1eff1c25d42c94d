// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/tessellation/cap_sums.h"

namespace wscvt {

namespace {

/// Small, so that the threads also share the coarsest level's hundreds of seeds.
constexpr std::size_t weight_block = 128;

/// Mean and standard deviation of `field` weighted by `density`.
FieldDeviation deviation_of(const GridField& field, const GridField& density) {
  GridField product = density;
  const auto moment = [&](const auto& f) {
    for (std::size_t i = 0; i < product.values.size(); ++i) {
      product.values[i] = density.values[i] * f(field.values[i]);
    }
    return product.integral([](double value) { return value; });
  };
  const double mass = moment([](double) { return 1.0; });
  const double mean = moment([](double v) { return v; }) / mass;
  const double variance = moment([&](double v) { return (v - mean) * (v - mean); }) / mass;
  return {mean, std::sqrt(std::max(0.0, variance))};
}

/// Returns C such that the integral over the sphere of 1 / max(smallest, cell + C) is `count`:
/// Newton's method, bracketed, because the integral falls with C.
double solve_offset(const GridField& cells, double count, double smallest) {
  const double mean_cell = 4.0 * pi / count;
  double low = -20.0 * mean_cell;
  double high = 20.0 * mean_cell;
  double offset = 0.0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double excess = cells.integral([&](double cell) {
      return 1.0 / std::max(smallest, cell + offset);
    }) - count;
    const double slope = -cells.integral([&](double cell) {
      return cell + offset > smallest ? 1.0 / ((cell + offset) * (cell + offset)) : 0.0;
    });
    (excess > 0.0 ? low : high) = offset;
    double next = offset - excess / slope;
    // If all cells have the smallest size, the slope is 0 and Newton's step invalid: then halving.
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - offset) < 1e-9 * mean_cell) return next;
    offset = next;
  }
  return offset;
}

}  // namespace

SurfaceSeedModel::SurfaceSeedModel(const RadialSurface& surface, const WeightingOptions& options,
                                   int node_count, const Execution& execution)
    : node_count_((check_weighting_options(options), node_count)) {
  if (node_count < 4) {
    throw Error(ErrorCode::InvalidInput, "The number of nodes is " + std::to_string(node_count) +
                                             ". A closed mesh needs at least 4.");
  }
  const double count = node_count;
  const TabulatedSurface table(surface, node_count, execution);
  const int rows = table.rows();
  rule_ = weighting_rule(table, options, execution);
  GridField field(rows);
  if (!rule_.field.empty()) {
    field.values = std::move(rule_.field);
    field_.emplace(rows, rule_.stencil, field.values);
  }

  // The cells' areas 3.118 w + C sum to the sphere if C makes the integral of 1 / area equal N.
  // WSCVT-C's weights depend on mean and deviation over the seeds, which depend on their density.
  const double smallest = smallest_cell_share * 4.0 * pi / count;
  GridField cells(rows);
  const int rounds = rule_.reads_deviation ? 4 : 1;
  for (int round = 0; round < rounds; ++round) {
    if (rule_.reads_deviation) {
      GridField density(rows);
      for (std::size_t i = 0; i < density.values.size(); ++i) {
        density.values[i] = round == 0 ? 1.0 : 1.0 / std::max(smallest, cells.values[i] + offset_);
      }
      wanted_ = deviation_of(field, density);
    }
    for (std::size_t i = 0; i < cells.values.size(); ++i) {
      cells.values[i] = cell_area_per_weight * rule_.weight(field.values[i], count, wanted_);
    }
    offset_ = solve_offset(cells, count, smallest);
  }
}

void SurfaceSeedModel::weights(const std::vector<Vector3>& seeds, const Execution& execution,
                               std::vector<double>& result) const {
  result.clear();
  if (!field_) return;
  result.resize(seeds.size());
  execution.parallel_for(seeds.size(), weight_block, [&](std::size_t begin, std::size_t end) {
    field_->interpolate(seeds.data() + begin, end - begin, result.data() + begin);
  });
  const auto count = static_cast<double>(seeds.size());
  FieldDeviation over_seeds;
  if (rule_.reads_deviation) {
    for (const double value : result) over_seeds.mean += value / count;
    double squares = 0.0;
    for (const double value : result) {
      squares += (value - over_seeds.mean) * (value - over_seeds.mean);
    }
    over_seeds.deviation = std::sqrt(squares / (count - 1.0));
  }
  for (double& value : result) value = rule_.weight(value, count, over_seeds);
}

double SurfaceSeedModel::number_density(double value) const {
  const double mean_cell = 4.0 * pi / node_count_;
  return 1.0 / std::max(smallest_cell_share * mean_cell,
                        cell_area_per_weight * rule_.weight(value, node_count_, wanted_) + offset_);
}

std::vector<double> SurfaceSeedModel::number_densities(const std::vector<Vector3>& directions,
                                                       const Execution& execution) const {
  std::vector<double> result(directions.size(), 0.0);
  execution.parallel_for(result.size(), weight_block, [&](std::size_t begin, std::size_t end) {
    if (field_) field_->interpolate(directions.data() + begin, end - begin, result.data() + begin);
    for (std::size_t i = begin; i < end; ++i) result[i] = number_density(result[i]);
  });
  return result;
}

}  // namespace wscvt
