// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/tessellation/cap_sums.h"

namespace wscvt {

namespace {

/// Rows that resolve both the surface and the cells: 128 rows are 1.4 degrees, a third of a cell of
/// 2000 and an eighth of a period of degree 30.
int rows_for(int node_count) { return node_count <= 2000 ? 128 : 256; }

/// Returns the area of the surface by quadrature on a seventh of as many nodes as the grid has.
/// This gives it to 1e-5 on series of degree 20 and to 1e-3 on series of degree 60 (sixteen scans).
/// Cells follow a weight only to some per cent.
double quick_area(const RadialSurface& surface, int rows, const Execution& execution) {
  return surface_area(surface, 3 * rows / 8, execution);
}

/// WSCVT-D, the paper's eq. 10.
WeightingRule radial_distance_weighting(const RadialSurface& surface, int rows,
                                        const Execution& execution) {
  WeightingRule rule;
  rule.field = surface.radii(SphereGrid::directions(rows), execution);
  rule.stencil = 6;
  rule.weight = [area = quick_area(surface, rows, execution)](double radius, double count,
                                                              const FieldDeviation&) {
    return area / (count * pi * radius * radius);
  };
  return rule;
}

/// Equal surface areas.
WeightingRule area_weighting(const RadialSurface& surface, int rows, const Execution& execution) {
  GridField elements(rows);
  elements.values = area_elements(surface, SphereGrid::directions(rows), execution).elements;
  WeightingRule rule;
  rule.weight = [area = elements.integral([](double g) { return g; })](double element, double count,
                                                                       const FieldDeviation&) {
    return area / (cell_area_per_weight * count * element);
  };
  rule.field = std::move(elements.values);
  rule.stencil = 6;
  return rule;
}

/// Returns the root mean square of the surface's largest curvature over caps of 0.6 h about the
/// nodes of the grid, h = sqrt(4 pi / N). Cells cannot follow finer detail, which would keep the
/// iteration from settling.
std::vector<double> smoothed_curvature(const RadialSurface& surface, int node_count, int rows,
                                       const Execution& execution) {
  constexpr std::size_t block = 1024;
  const double radius = 0.6 * std::sqrt(4.0 * pi / node_count);
  GridField moment(rows);
  GridField measure(rows);
  const std::size_t columns = moment.columns();
  const std::vector<Vector3> nodes = SphereGrid::directions(rows);
  execution.parallel_for(nodes.size(), block, [&](std::size_t begin, std::size_t end) {
    std::vector<RadialJet> jets(end - begin);
    surface.evaluate(nodes.data() + begin, jets.size(), Derivatives::Second, jets.data());
    for (std::size_t i = begin; i < end; ++i) {
      const PrincipalCurvatures k = principal_curvatures(jets[i - begin], nodes[i]);
      const double share = moment.sines[i / columns];
      moment.values[i] = share * std::max(k.maximum * k.maximum, k.minimum * k.minimum);
      measure.values[i] = share;
    }
  });
  std::vector<double> result = sum_over_caps(moment, radius, execution);
  const std::vector<double> measures = sum_over_caps(measure, radius, execution);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::sqrt(result[i] / measures[i]);
  return result;
}

/// WSCVT-C, the paper's eqs. 11 to 14.
WeightingRule curvature_weighting(const RadialSurface& surface, double alpha, int node_count,
                                  int rows, const Execution& execution) {
  WeightingRule rule;
  rule.field = smoothed_curvature(surface, node_count, rows, execution);
  const double radius = std::sqrt(quick_area(surface, rows, execution) / (4.0 * pi));
  for (double& k : rule.field) k = -portable::log(std::max(k * radius, flat_curvature));
  rule.reads_deviation = true;
  rule.weight = [alpha](double value, double count, const FieldDeviation& over_seeds) {
    // A sphere's rounding errors are not curvature.
    if (!(over_seeds.deviation > 1e-9)) return 0.0;
    const double deviation = std::max(over_seeds.deviation, smallest_deviation);
    const double x = alpha * (value - over_seeds.mean) / (3.0 * deviation);
    return 4.0 / count * std::clamp(x, -curvature_clip, curvature_clip);
  };
  return rule;
}

WeightingRule weighting_rule(const RadialSurface& surface, const WeightingOptions& options,
                             int node_count, const Execution& execution) {
  const int rows = rows_for(node_count);
  switch (options.kind) {
    case Weighting::Constant:
      break;
    case Weighting::RadialDistance:
      return radial_distance_weighting(surface, rows, execution);
    case Weighting::Curvature:
      return curvature_weighting(surface, options.curvature_alpha, node_count, rows, execution);
    case Weighting::Area:
      return area_weighting(surface, rows, execution);
  }
  WeightingRule constant;
  constant.weight = [](double, double, const FieldDeviation&) { return 0.0; };
  return constant;
}

}  // namespace

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
    : node_count_(node_count) {
  require_valid(options.kind);
  require_in_range(options.curvature_alpha, curvature_alpha_option);
  if (node_count < 4) {
    refuse("The number of nodes is " + std::to_string(node_count) +
           ". A closed mesh needs at least 4.");
  }
  const double count = node_count;
  const int rows = rows_for(node_count);
  rule_ = weighting_rule(surface, options, node_count, execution);
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

std::vector<double> SurfaceSeedModel::number_densities(const std::vector<Vector3>& directions,
                                                       const Execution& execution) const {
  const double smallest = smallest_cell_share * (4.0 * pi / node_count_);
  std::vector<double> result(directions.size(), 0.0);
  execution.parallel_for(result.size(), weight_block, [&](std::size_t begin, std::size_t end) {
    if (field_) field_->interpolate(directions.data() + begin, end - begin, result.data() + begin);
    for (std::size_t i = begin; i < end; ++i) {
      const double cell =
          cell_area_per_weight * rule_.weight(result[i], node_count_, wanted_) + offset_;
      result[i] = 1.0 / std::max(smallest, cell);
    }
  });
  return result;
}

namespace {

/// More seeds than this surround the centre for any random seed: 50 random points all lie in one
/// half of the sphere with a probability of 2e-12 (Wendel 1962).
constexpr int surely_surrounding = 50;

bool can_be_triangulated(const std::vector<Vector3>& seeds) {
  return static_cast<int>(seeds.size()) > surely_surrounding ||
         SphereTriangulation::try_build(seeds).has_value();
}

}  // namespace

bool takes_any_count(Sampling sampling) {
  return sampling == Sampling::Weighted || sampling == Sampling::Fibonacci;
}

std::vector<Vector3> unrelaxed_seeds(Sampling sampling, int count) {
  switch (sampling) {
    case Sampling::Fibonacci:
      return fibonacci_lattice(count);
    case Sampling::EqualAngle:
      return nearest_equal_angle_grid(count);
    case Sampling::Icosahedron:
      return nearest_subdivided_icosahedron(count);
    case Sampling::Weighted:
      break;
  }
  refuse("The weighted sampling is the result of a relaxation. Use another sampling, or relax.");
}

std::vector<Vector3> start_seeds(const SurfaceSeedModel& model, int count,
                                 const Execution& execution) {
  const int rows = std::clamp(static_cast<int>(2.0 * std::sqrt(count)), 64, 360);
  const auto density = [&](const std::vector<Vector3>& directions) {
    return model.number_densities(directions, execution);
  };
  std::vector<Vector3> seeds = warped_lattice(count, density, rows);
  return can_be_triangulated(seeds) ? seeds : fibonacci_lattice(count);
}

}  // namespace wscvt
