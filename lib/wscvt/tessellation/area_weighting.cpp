// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/seed_model.h"
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

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

}  // namespace wscvt
