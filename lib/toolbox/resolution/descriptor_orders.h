// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace wscvt {

/// How the error of a descriptor falls with the size of a voxel, and how well that is known.
struct DescriptorOrder {
  std::string_view key;  ///< as in list_descriptors
  double least_across;   ///< voxels across, below which the descriptor is not resolved
  /// p: the bias is proportional to the size of a voxel to this power; infinite: no correction.
  double order;
  double floor;  ///< f: the fraction that no smaller voxels take away
  /// The interval of 95 % reaches below the corrected value by `share` of the change from voxels of
  /// twice the size, `scatters` times the standard deviation of the poses, and `rest` of the value
  /// over the voxels across; and above it by `above` times as much. Voxels hide detail, so that
  /// most errors have one sign.
  double share;
  double scatters;
  double rest;
  double above;
};

/// Returns the order of a descriptor; nullptr for descriptors without one. Measured by
/// tests/figures/study/resolution_study.py, which prints the table.
const DescriptorOrder* order_of(std::string_view key);

}  // namespace wscvt
