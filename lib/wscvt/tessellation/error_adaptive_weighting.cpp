// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/tessellation/seed_model.h"
#include "wscvt/tessellation/smoothed_curvature.h"
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

namespace {

double mean_square(const PrincipalCurvatures& k) {
  return 0.5 * (k.maximum * k.maximum + k.minimum * k.minimum);
}

}  // namespace

WeightingRule error_adaptive_weighting(const TabulatedSurface& table,
                                       const WeightingOptions& options,
                                       const Execution& execution) {
  const GridField& elements = table.area_elements();  // first, so that the area comes from them
  const double radius = table.radius();
  GridField field = smoothed_curvature(table, mean_square, execution);
  std::vector<double> order = field.values;
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  std::nth_element(order.begin(), middle, order.end());
  const double floor = std::max(flat_share_of_median * *middle, flat_curvature / radius);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double k = std::max(field.values[i], floor);
    field.values[i] =
        std::log(elements.values[i]) + options.adaptive_exponent * std::log(k * radius);
  }
  const double total = field.integral([](double logarithm) { return std::exp(logarithm); });
  WeightingRule rule;
  // The density's logarithm, which is interpolated more faithfully than what varies by powers.
  rule.field = std::move(field.values);
  rule.weight = [total](double logarithm, double count, const FieldDeviation&) {
    return total * std::exp(-logarithm) / (cell_area_per_weight * count);
  };
  return rule;
}

}  // namespace wscvt
