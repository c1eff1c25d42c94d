// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/shape_descriptors.h"

namespace wscvt {

/// One descriptor ready to be shown or stored.
struct DescriptorValue {
  std::string key;    ///< lower_case name in files; never changes between versions
  std::string label;  ///< for people, names the convention where there are several
  std::string unit;   ///< "length", "length^2", "length^3" or empty
  double value = 0.0;
  /// False where zero is an ordinary value, so that an error in per cent would say nothing.
  bool on_ratio_scale = true;
};

/// One descriptor of two meshes.
struct DescriptorComparison {
  std::string key;
  std::string label;
  std::string unit;
  double reference = 0.0;
  double value = 0.0;
  double error_percent = 0.0;  ///< 100 (value / reference - 1); NaN where that says nothing
};

std::vector<DescriptorValue> list_descriptors(const ShapeDescriptors& descriptors);

/// Row by row. Throws Error(InvalidInput) when the two lists do not hold the same descriptors.
std::vector<DescriptorComparison> compare_descriptors(const std::vector<DescriptorValue>& reference,
                                                      const std::vector<DescriptorValue>& values);

}  // namespace wscvt
