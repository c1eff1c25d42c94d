// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// One descriptor ready to be shown or stored.
struct DescriptorValue {
  std::string key;     ///< lower_case name in files; never changes between versions
  std::string label;   ///< for people, names the convention where there are several
  std::string unit;    ///< "length", "length^2", "length^3" or empty
  double value = 0.0;  ///< NaN where the descriptor does not exist for this body
  /// False where zero is an ordinary value, so that an error in per cent would say nothing.
  bool on_ratio_scale = true;
};

/// One descriptor of two meshes.
struct DescriptorComparison {
  std::string key;  ///< as in DescriptorValue, and so the next two
  std::string label;
  std::string unit;
  double reference = 0.0;  ///< of the original; in `unit`
  double value = 0.0;      ///< of the other mesh; in `unit`
  double error_percent =
      0.0;  ///< 100 (value / reference - 1); NaN where that says nothing, see compare_descriptors
};

/// The descriptors as rows, always in the same order. Those that do not exist for a body
/// (see DetailedDescriptors::has_roughness and has_radius) are NaN.
std::vector<DescriptorValue> list_descriptors(const ShapeDescriptors& descriptors);
std::vector<DescriptorValue> list_descriptors(const DetailedDescriptors& descriptors);

/// Row by row. An error in per cent says nothing where zero is an ordinary value and where the
/// reference lies near zero: below a thousandth of 1, or of the largest value with its unit. Throws
/// Error(InvalidInput) when the two lists do not hold the same descriptors.
std::vector<DescriptorComparison> compare_descriptors(const std::vector<DescriptorValue>& reference,
                                                      const std::vector<DescriptorValue>& values);

/// Names of the columns of two meshes, in text and in files.
struct ComparisonNames {
  std::string reference = "scan";
  std::string value = "remesh";
};

/// An aligned table: descriptor / value, and descriptor / reference / value / error %.
std::vector<std::string> table_lines(const std::vector<DescriptorValue>& values);
std::vector<std::string> table_lines(const std::vector<DescriptorComparison>& rows,
                                     const ComparisonNames& names);

}  // namespace wscvt
