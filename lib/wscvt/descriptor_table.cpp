// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/descriptor_table.h"

#include <limits>

#include "wscvt/error.h"

namespace wscvt {

std::vector<DescriptorValue> list_descriptors(const ShapeDescriptors& d) {
  return {
      {"volume", "volume", "length^3", d.volume},
      {"area", "surface area", "length^2", d.area},
      {"aspect_ratio_inertia", "aspect ratio S/L (inertia ellipsoid)", "", d.aspect_ratio},
      {"sphericity_wadell", "sphericity (Wadell)", "", d.sphericity},
      {"sdq_invariant", "Sdq (invariant form)", "", d.sdq},
      {"semi_axis_s_inertia", "semi-axis S (inertia ellipsoid)", "length", d.inertia_semi_axes[0]},
      {"semi_axis_i_inertia", "semi-axis I (inertia ellipsoid)", "length", d.inertia_semi_axes[1]},
      {"semi_axis_l_inertia", "semi-axis L (inertia ellipsoid)", "length", d.inertia_semi_axes[2]},
  };
}

std::vector<DescriptorComparison> compare_descriptors(const std::vector<DescriptorValue>& reference,
                                                      const std::vector<DescriptorValue>& values) {
  if (reference.size() != values.size()) {
    throw Error(ErrorCode::InvalidInput,
                "The two lists hold " + std::to_string(reference.size()) + " and " +
                    std::to_string(values.size()) +
                    " descriptors; compare lists made by the same function.");
  }
  std::vector<DescriptorComparison> rows;
  rows.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const DescriptorValue& from = reference[i];
    const DescriptorValue& to = values[i];
    if (from.key != to.key) {
      throw Error(ErrorCode::InvalidInput,
                  "Row " + std::to_string(i) + " holds " + from.key + " in one list and " + to.key +
                      " in the other; compare lists made by the same function.");
    }
    const double error = from.on_ratio_scale ? relative_error_percent(to.value, from.value)
                                             : std::numeric_limits<double>::quiet_NaN();
    rows.push_back({from.key, from.label, from.unit, from.value, to.value, error});
  }
  return rows;
}

}  // namespace wscvt
