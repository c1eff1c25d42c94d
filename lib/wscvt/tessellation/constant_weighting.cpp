// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

WeightingRule constant_weighting(const TabulatedSurface& /*table*/,
                                 const WeightingOptions& /*options*/,
                                 const Execution& /*execution*/) {
  WeightingRule rule;
  rule.weight = [](double, double, const FieldDeviation&) { return 0.0; };
  return rule;
}

}  // namespace wscvt
