// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

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

}  // namespace wscvt
