// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
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

/// Equal solid angles.
WeightingRule constant_weighting(const TabulatedSurface& /*table*/,
                                 const WeightingOptions& /*options*/,
                                 const Execution& /*execution*/) {
  WeightingRule rule;
  rule.weight = [](double, double, const FieldDeviation&) { return 0.0; };
  return rule;
}

/// WSCVT-D, the paper's eq. 10.
WeightingRule radial_distance_weighting(const TabulatedSurface& table,
                                        const WeightingOptions& /*options*/,
                                        const Execution& /*execution*/) {
  WeightingRule rule;
  rule.field = table.radii();
  rule.stencil = 6;
  rule.weight = [area = table.area()](double radius, double count, const FieldDeviation&) {
    return area / (count * pi * radius * radius);
  };
  return rule;
}

/// Equal surface areas.
WeightingRule area_weighting(const TabulatedSurface& table, const WeightingOptions& /*options*/,
                             const Execution& /*execution*/) {
  WeightingRule rule;
  rule.field = table.area_elements().values;
  rule.stencil = 6;
  rule.weight = [area = table.area()](double element, double count, const FieldDeviation&) {
    return area / (cell_area_per_weight * count * element);
  };
  return rule;
}

constexpr std::size_t curvature_block = 1024;

/// Combines a pair of principal curvatures into one number whose square is averaged.
using CurvatureSquare = double (*)(const PrincipalCurvatures&);

/// Returns the root mean square of the surface's curvature over caps of 0.6 h about the nodes of
/// the table's grid, h = sqrt(4 pi / N). Cells cannot follow finer detail, which would keep the
/// iteration from settling.
GridField smoothed_curvature(const TabulatedSurface& table, CurvatureSquare square,
                             const Execution& execution) {
  const int rows = table.rows();
  const double radius = 0.6 * std::sqrt(4.0 * pi / table.node_count());
  GridField moment(rows);
  GridField measure(rows);
  const std::size_t columns = moment.columns();
  const std::vector<Vector3> nodes = SphereGrid::directions(rows);
  execution.parallel_for(nodes.size(), curvature_block, [&](std::size_t begin, std::size_t end) {
    std::vector<RadialJet> jets(end - begin);
    table.surface().evaluate(nodes.data() + begin, jets.size(), Derivatives::Second, jets.data());
    for (std::size_t i = begin; i < end; ++i) {
      const double share = moment.sines[i / columns];
      moment.values[i] = share * square(principal_curvatures(jets[i - begin], nodes[i]));
      measure.values[i] = share;
    }
  });
  const std::vector<double> moments = sum_over_caps(moment, radius, execution).sums;
  const std::vector<double> measures = sum_over_caps(measure, radius, execution).sums;
  GridField result(rows);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = std::sqrt(moments[i] / measures[i]);
  }
  return result;
}

/// Smallest deviation of the logarithm of the curvature; below it the grain counts as a sphere. Eq.
/// 14 divides by the deviation, so on a scanned sphere it would gather the nodes by the scan's
/// noise.
constexpr double smallest_deviation = 0.05;

double largest_square(const PrincipalCurvatures& k) {
  return std::max(k.maximum * k.maximum, k.minimum * k.minimum);
}

/// WSCVT-C, the paper's eqs. 11 to 14.
WeightingRule curvature_weighting(const TabulatedSurface& table, const WeightingOptions& options,
                                  const Execution& execution) {
  WeightingRule rule;
  rule.field = smoothed_curvature(table, largest_square, execution).values;
  const double radius = table.radius();
  for (double& k : rule.field) k = -portable::log(std::max(k * radius, flat_curvature));
  rule.reads_deviation = true;
  rule.weight = [alpha = options.curvature_alpha](double value, double count,
                                                  const FieldDeviation& over_seeds) {
    // A sphere's rounding errors are not curvature.
    if (!(over_seeds.deviation > 1e-9)) return 0.0;
    const double deviation = std::max(over_seeds.deviation, smallest_deviation);
    const double x = alpha * (value - over_seeds.mean) / (3.0 * deviation);
    return 4.0 / count * std::clamp(x, -curvature_clip, curvature_clip);
  };
  return rule;
}

/// Rows that resolve both the surface and the cells: 128 rows are 1.4 degrees, a third of a cell of
/// 2000 and an eighth of a period of degree 30.
int rows_for(int node_count) { return node_count <= 2000 ? 128 : 256; }

}  // namespace

void check_weighting_options(const WeightingOptions& options) {
  require_valid(options.kind);
  require_in_range(options.curvature_alpha, curvature_alpha_option);
}

WeightingRule weighting_rule(const TabulatedSurface& table, const WeightingOptions& options,
                             const Execution& execution) {
  constexpr decltype(&constant_weighting) functions[] = {
      constant_weighting,  // in the order of the enumeration
      radial_distance_weighting, curvature_weighting, area_weighting};
  static_assert(std::size(functions) == std::size(enumerators<Weighting>()),
                "every weighting has a function");
  check_weighting_options(options);
  return functions[static_cast<std::size_t>(options.kind)](table, options, execution);
}

TabulatedSurface::TabulatedSurface(const RadialSurface& surface, int node_count,
                                   const Execution& execution)
    : surface_(surface), node_count_(node_count), execution_(execution) {}

int TabulatedSurface::rows() const { return rows_for(node_count_); }

const std::vector<double>& TabulatedSurface::radii() const {
  if (radii_.empty()) {
    radii_ = surface_.radii(SphereGrid::directions(rows()), execution_);
  }
  return radii_;
}

const GridField& TabulatedSurface::area_elements() const {
  if (!area_elements_) {
    AreaElements read = wscvt::area_elements(surface_, SphereGrid::directions(rows()), execution_);
    radii_ = std::move(read.radii);
    area_elements_.emplace(rows()).values = std::move(read.elements);
  }
  return *area_elements_;
}

double TabulatedSurface::area() const {
  // If only the area is needed, quadrature on a seventh of as many nodes gives it to 1e-5 on series
  // of degree 20 and to 1e-3 on series of degree 60 (sixteen scans). Cells follow a weight only to
  // some per cent.
  return area_elements_ ? area_elements_->integral([](double g) { return g; })
                        : surface_area(surface_, 3 * rows() / 8, execution_);
}

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
    refuse("The number of nodes is " + std::to_string(node_count) +
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
