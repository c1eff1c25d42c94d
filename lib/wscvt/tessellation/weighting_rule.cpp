// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weighting_rule.h"

#include <cstddef>
#include <iterator>

namespace wscvt {

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

}  // namespace wscvt
