// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weights.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "wscvt/tessellation/cap_sums.h"

namespace wscvt {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t block_size = 1024;
/// Largest alpha x of eq. 11, whose weight is then 3.6 / N: 3.118 times that is 0.89 of the mean
/// cell, so that no cell is wanted smaller than nothing. Beyond it seeds lose their cells (measured
/// above alpha 1.25).
constexpr double curvature_clip = 0.9;
/// Deviation of the logarithm of the curvature below which the grain counts as a sphere: a
/// twentieth. Eq. 14 measures by the deviation itself, so that on a scanned sphere it would gather
/// the nodes by the scan's noise.
constexpr double smallest_deviation = 0.05;
/// Curvatures below these are taken as these: a flat face has no scale of its own.
constexpr double flat_curvature = 0.01;       // in 1 / equivalent radius, for the logarithm
constexpr double flat_share_of_median = 0.3;  // of the median curvature, for the adaptive density

/// Rows so that the grid resolves both the surface and the cells: 128 rows are 1.4 degrees, a third
/// of a cell of 2000 and an eighth of a period of degree 30.
int rows_for(int node_count) { return node_count <= 2000 ? 128 : 256; }

/// How a pair of principal curvatures is made one number whose square is averaged.
using CurvatureSquare = double (*)(const PrincipalCurvatures&);

double largest_square(const PrincipalCurvatures& k) {
  return std::max(k.maximum * k.maximum, k.minimum * k.minimum);
}
double mean_square(const PrincipalCurvatures& k) {
  return 0.5 * (k.maximum * k.maximum + k.minimum * k.minimum);
}

/// Root mean square over caps of `radius` of the curvature; the surface's own, or of samples.
GridField smoothed_curvature(const RadialSurface& surface, const CurvatureSamples* samples,
                             CurvatureSquare square, int rows, double radius,
                             const Execution& execution) {
  GridField moment(rows);
  GridField measure(rows);
  const std::size_t columns = moment.columns();
  if (samples == nullptr) {
    const std::vector<Vector3> nodes = SphereGrid(rows, 1, 4).directions();
    execution.parallel_for(nodes.size(), block_size, [&](std::size_t begin, std::size_t end) {
      std::vector<RadialJet> jets(end - begin);
      surface.evaluate(nodes.data() + begin, end - begin, Derivatives::Second, jets.data());
      for (std::size_t i = begin; i < end; ++i) {
        const double share = moment.sines[i / columns];
        moment.values[i] = share * square(principal_curvatures(jets[i - begin], nodes[i]));
        measure.values[i] = share;
      }
    });
  } else {
    for (std::size_t i = 0; i < samples->directions.size(); ++i) {
      const Vector3& u = samples->directions[i];
      const double theta = std::acos(std::clamp(u.z(), -1.0, 1.0));
      const double phi = std::atan2(u.y(), u.x());
      const int row = std::min(static_cast<int>(theta * rows / pi), rows - 1);
      const auto column = static_cast<std::size_t>(
          (static_cast<int>(std::lround(phi * rows / pi)) + 2 * rows) % (2 * rows));
      moment.values[row * columns + column] += samples->weights[i] * square(samples->curvatures[i]);
      measure.values[row * columns + column] += samples->weights[i];
    }
  }
  GridField result(rows);
  std::vector<char> known(result.values.size(), 0);
  // Samples may leave caps empty: those are looked for again in caps of twice the size.
  for (bool complete = false; !complete; radius *= 2.0) {
    const std::vector<double> moments = sum_over_caps(moment, radius, execution).sums;
    const std::vector<double> measures = sum_over_caps(measure, radius, execution).sums;
    complete = true;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      if (known[i] != 0) continue;
      if (measures[i] > 0.0) {
        result.values[i] = std::sqrt(moments[i] / measures[i]);
        known[i] = 1;
      } else {
        complete = false;
      }
    }
    if (radius > 2.0) break;
  }
  return result;
}

/// Radius and area element at the nodes of a grid, from one pass over the surface.
struct TabulatedSurface {
  std::vector<double> radii;
  std::vector<double> area_elements;
};

TabulatedSurface tabulate(const RadialSurface& surface, int rows, const Execution& execution) {
  const std::vector<Vector3> nodes = SphereGrid(rows, 1, 4).directions();
  TabulatedSurface table;
  table.radii.resize(nodes.size());
  table.area_elements.resize(nodes.size());
  execution.parallel_for(nodes.size(), block_size, [&](std::size_t begin, std::size_t end) {
    std::vector<RadialJet> jets(end - begin);
    surface.evaluate(nodes.data() + begin, end - begin, Derivatives::First, jets.data());
    for (std::size_t i = begin; i < end; ++i) {
      table.radii[i] = jets[i - begin].radius;
      table.area_elements[i] = area_element(jets[i - begin]);
    }
  });
  return table;
}

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

/// C such that the integral over the sphere of 1 / max(smallest, cell + C) is `count`: Newton's
/// method, kept inside the bracket where the integral, which falls with C, passes `count`.
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
    // Where all cells are at the smallest the slope is 0 and Newton's step no number: then halving.
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - offset) < 1e-9 * mean_cell) return next;
    offset = next;
  }
  return offset;
}

}  // namespace

void check_weighting_options(const WeightingOptions& options) {
  require_valid(options.kind);
  require_valid(options.curvature_source);
  require_in_range(options.curvature_alpha, curvature_alpha_option);
  require_in_range(options.adaptive_exponent, adaptive_exponent_option);
}

SurfaceSeedModel::SurfaceSeedModel(const RadialSurface& surface, const WeightingOptions& options,
                                   int node_count, const CurvatureSamples* samples,
                                   const Execution& execution)
    : options_((check_weighting_options(options), options)), node_count_(node_count) {
  if (node_count < 4) {
    throw Error(ErrorCode::InvalidInput, "The number of nodes is " + std::to_string(node_count) +
                                             "; a closed mesh needs at least 4.");
  }
  const int rows = rows_for(node_count);
  const double count = node_count;
  TabulatedSurface table = tabulate(surface, rows, execution);
  radius_.emplace(rows, 1, 6, table.radii);
  area_element_.emplace(rows, 1, 6, table.area_elements);
  GridField area(rows);
  area.values = std::move(table.area_elements);
  area_ = area.integral([](double g) { return g; });

  GridField field(rows);
  const double cap_radius = 0.6 * std::sqrt(4.0 * pi / count);
  const double radius = std::sqrt(area_ / (4.0 * pi));
  if (options.kind == Weighting::RadialDistance) {
    field.values = std::move(table.radii);
  } else if (options.kind == Weighting::Area) {
    field.values = area.values;
  } else if (options.kind == Weighting::Curvature) {
    field = smoothed_curvature(surface, samples, largest_square, rows, cap_radius, execution);
    for (double& k : field.values) k = -std::log(std::max(k * radius, flat_curvature));
    field_.emplace(rows, 1, 4, field.values);
  } else if (options.kind == Weighting::ErrorAdaptive) {
    field = smoothed_curvature(surface, samples, mean_square, rows, cap_radius, execution);
    std::vector<double> order = field.values;
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    std::nth_element(order.begin(), middle, order.end());
    const double floor = std::max(flat_share_of_median * *middle, flat_curvature / radius);
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      const double k = std::max(field.values[i], floor);
      field.values[i] = std::log(area.values[i]) + options.adaptive_exponent * std::log(k * radius);
    }
    field_.emplace(rows, 1, 4, field.values);
    total_ = field.integral([](double logarithm) { return std::exp(logarithm); });
  }

  // The cells' areas 3.118 w + C add up to the sphere when C makes the integral of 1 / area equal
  // N. WSCVT-C's weights depend on mean and deviation over the seeds, which depend on their
  // density.
  const double smallest = smallest_cell_share * 4.0 * pi / count;
  GridField cells(rows);
  const int rounds = options.kind == Weighting::Curvature ? 4 : 1;
  for (int round = 0; round < rounds; ++round) {
    if (options.kind == Weighting::Curvature) {
      GridField density(rows);
      for (std::size_t i = 0; i < density.values.size(); ++i) {
        density.values[i] = round == 0 ? 1.0 : 1.0 / std::max(smallest, cells.values[i] + offset_);
      }
      wanted_ = deviation_of(field, density);
    }
    for (std::size_t i = 0; i < cells.values.size(); ++i) {
      cells.values[i] = cell_area_per_weight * weight_from(field.values[i], count, wanted_);
    }
    offset_ = solve_offset(cells, count, smallest);
  }
}

double SurfaceSeedModel::weight_from(double field, double count,
                                     const FieldDeviation& over_seeds) const {
  switch (options_.kind) {
    case Weighting::RadialDistance:  // eq. 10
      return area_ / (count * pi * field * field);
    case Weighting::Area:
      return area_ / (cell_area_per_weight * count * field);
    case Weighting::ErrorAdaptive:
      return total_ * std::exp(-field) / (cell_area_per_weight * count);
    case Weighting::Curvature: {  // eqs. 11 to 14; a sphere's rounding errors are no curvature
      if (!(over_seeds.deviation > 1e-9)) return 0.0;
      const double deviation = std::max(over_seeds.deviation, smallest_deviation);
      const double x = options_.curvature_alpha * (field - over_seeds.mean) / (3.0 * deviation);
      return 4.0 / count * std::clamp(x, -curvature_clip, curvature_clip);
    }
    case Weighting::Constant:
      break;
  }
  return 0.0;
}

void SurfaceSeedModel::look_up(const SphereGrid& grid, const std::vector<Vector3>& seeds,
                               const Execution& execution, std::vector<double>& result) const {
  result.resize(seeds.size());
  execution.parallel_for(seeds.size(), block_size, [&](std::size_t begin, std::size_t end) {
    grid.interpolate(seeds.data() + begin, end - begin, result.data() + begin);
  });
}

void SurfaceSeedModel::look_up_field(const std::vector<Vector3>& seeds, const Execution& execution,
                                     std::vector<double>& result) const {
  switch (options_.kind) {
    case Weighting::Constant:
      result.assign(seeds.size(), 0.0);
      break;
    case Weighting::RadialDistance:
      look_up(*radius_, seeds, execution, result);
      break;
    case Weighting::Area:
      look_up(*area_element_, seeds, execution, result);
      break;
    case Weighting::Curvature:
    case Weighting::ErrorAdaptive:
      look_up(*field_, seeds, execution, result);
      break;
  }
}

void SurfaceSeedModel::weights(const std::vector<Vector3>& seeds, const Execution& execution,
                               std::vector<double>& result) const {
  result.clear();
  if (options_.kind == Weighting::Constant) return;
  look_up_field(seeds, execution, result);
  const auto count = static_cast<double>(seeds.size());
  FieldDeviation over_seeds;
  if (options_.kind == Weighting::Curvature) {
    for (const double value : result) over_seeds.mean += value / count;
    double squares = 0.0;
    for (const double value : result) {
      squares += (value - over_seeds.mean) * (value - over_seeds.mean);
    }
    over_seeds.deviation = std::sqrt(squares / (count - 1.0));
  }
  for (double& value : result) value = weight_from(value, count, over_seeds);
}

void SurfaceSeedModel::radii(const std::vector<Vector3>& seeds, const Execution& execution,
                             std::vector<double>& result) const {
  look_up(*radius_, seeds, execution, result);
}

void SurfaceSeedModel::surface_densities(const std::vector<Vector3>& seeds,
                                         const Execution& execution,
                                         std::vector<double>& result) const {
  if (options_.kind == Weighting::Area) {
    result.clear();
    return;
  }
  result = number_densities(seeds, execution);
  std::vector<double> elements;
  look_up(*area_element_, seeds, execution, elements);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] /= elements[i];
}

std::vector<double> SurfaceSeedModel::number_densities(const std::vector<Vector3>& directions,
                                                       const Execution& execution) const {
  const double mean_cell = 4.0 * pi / node_count_;
  std::vector<double> result;
  look_up_field(directions, execution, result);
  for (double& value : result) {
    value =
        1.0 / std::max(smallest_cell_share * mean_cell,
                       cell_area_per_weight * weight_from(value, node_count_, wanted_) + offset_);
  }
  return result;
}

}  // namespace wscvt
