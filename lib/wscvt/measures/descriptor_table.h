// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/voxel_resolution.h"

namespace wscvt {

/// One descriptor ready to be shown or stored.
struct DescriptorValue {
  std::string key;     ///< lower_case name in files; never changes between versions
  std::string label;   ///< for people; names the convention if there are several
  std::string unit;    ///< "length", "length^2", "length^3" or empty
  double value = 0.0;  ///< NaN if the descriptor does not exist for this body
  /// False if zero is an ordinary value, because an error in per cent then has no meaning.
  bool on_ratio_scale = true;
};

/// One descriptor of two meshes.
struct DescriptorComparison {
  std::string key;  ///< this and the next two as in DescriptorValue
  std::string label;
  std::string unit;
  double reference = 0.0;  ///< of the scan; in `unit`
  double value = 0.0;      ///< of the other mesh; in `unit`
  double error_percent =
      0.0;  ///< 100 (value / reference - 1); NaN if it has no meaning, see compare_descriptors
};

/// Returns the descriptors as rows, always in one order. Descriptors that do not exist for a body
/// (see DetailedDescriptors::has_roughness and has_radius) are NaN.
std::vector<DescriptorValue> list_descriptors(const ShapeDescriptors& descriptors);
std::vector<DescriptorValue> list_descriptors(const DetailedDescriptors& descriptors);

/// Returns a descriptor's label without the settings of one grain, which are the radius of the
/// balls and the cut-off length; empty if no descriptor has this key.
std::string descriptor_words(const std::string& key);

/// Whether a descriptor of form is one of those that a person reads first, which summaries show:
/// sphericity, convexity, elongation, flatness and roundness.
bool is_read_first(std::string_view key);

/// Compares row by row. An error in per cent has no meaning if zero is an ordinary value, or if the
/// reference is near zero: below a thousandth of 1, or of the largest value with its unit. Throws
/// Error(InvalidInput) if the two lists have different descriptors.
std::vector<DescriptorComparison> compare_descriptors(const std::vector<DescriptorValue>& reference,
                                                      const std::vector<DescriptorValue>& values);

/// Column names of two meshes, in text and in files.
struct ComparisonNames {
  std::string reference = "scan";
  std::string value = "remesh";
};

/// Returns an aligned table: descriptor / value, or descriptor / reference / value / error %.
std::vector<std::string> table_lines(const std::vector<DescriptorValue>& values);
/// With the columns corrected, low and high. `resolution` has a row for each value.
std::vector<std::string> table_lines(const std::vector<DescriptorValue>& values,
                                     const Resolution& resolution);
std::vector<std::string> table_lines(const std::vector<DescriptorComparison>& rows,
                                     const ComparisonNames& names);

/// Returns one row for the head and one for each value: label and unit, value, corrected, low,
/// high. The last two are empty if the descriptor is not resolved.
std::vector<std::vector<std::string>> resolution_rows(const std::vector<DescriptorValue>& values,
                                                      const Resolution& resolution);

/// Returns a sentence about what the voxels did: voxels across, the errors of area, sphericity,
/// convexity and roundness, and which of them are not resolved.
std::string resolution_sentence(const Resolution& resolution);

}  // namespace wscvt
