// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weighting_rule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "wscvt/base/portable_math.h"
#include "wscvt/tessellation/seed_model.h"

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
  rule.field = table.distances();
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
    std::vector<LocalShape> shapes(end - begin);
    table.surface().evaluate_shapes(nodes.data() + begin, shapes.size(), Derivatives::Second,
                                    shapes.data());
    for (std::size_t i = begin; i < end; ++i) {
      const double share = moment.sines[i / columns];
      moment.values[i] = share * square(shapes[i - begin].curvatures);
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

TabulatedSurface::TabulatedSurface(const SphereSurface& surface, int node_count,
                                   const Execution& execution)
    : surface_(surface), node_count_(node_count), execution_(execution) {}

int TabulatedSurface::rows() const { return rows_for(node_count_); }

const std::vector<double>& TabulatedSurface::distances() const {
  if (distances_.empty()) {
    distances_ = surface_.distances(SphereGrid::directions(rows()), execution_);
  }
  return distances_;
}

const GridField& TabulatedSurface::area_elements() const {
  if (!area_elements_) {
    AreaElements read = wscvt::area_elements(surface_, SphereGrid::directions(rows()), execution_);
    distances_ = std::move(read.distances);
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

}  // namespace wscvt
