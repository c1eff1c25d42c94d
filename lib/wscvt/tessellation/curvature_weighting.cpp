// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "wscvt/tessellation/smoothed_curvature.h"
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

namespace {

/// Smallest deviation of the logarithm of the curvature; below it the grain counts as a sphere. Eq.
/// 14 divides by the deviation, so on a scanned sphere it would gather the nodes by the scan's
/// noise.
constexpr double smallest_deviation = 0.05;

double largest_square(const PrincipalCurvatures& k) {
  return std::max(k.maximum * k.maximum, k.minimum * k.minimum);
}

}  // namespace

WeightingRule curvature_weighting(const TabulatedSurface& table, const WeightingOptions& options,
                                  const Execution& execution) {
  WeightingRule rule;
  rule.field = smoothed_curvature(table, largest_square, execution).values;
  const double radius = table.radius();
  for (double& k : rule.field) k = -std::log(std::max(k * radius, flat_curvature));
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

}  // namespace wscvt
