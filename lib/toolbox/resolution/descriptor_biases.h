// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace wscvt {

/// What voxels do to a descriptor, and how well that is known. `u` is 10 over the voxels across, of
/// which at most 40 were measured: more count as 40.
struct DescriptorBias {
  std::string_view key;  ///< as in list_descriptors
  double most;           ///< largest possible value; infinite for lengths and the like
  double least_across;   ///< voxels across, below which the descriptor is not resolved
  /// The first voxels took away gain + gain_u * u times what voxels take away once more. Zero, as
  /// the floor: no correction.
  double gain;
  double gain_u;
  /// The fraction of the value, floor + floor_u * u, that voxels take away from every grain.
  double floor;
  double floor_u;
  /// The interval of 95 % reaches below the corrected value by `share` of the change, `scatters`
  /// times the standard deviation of the poses, and `rest` of the value over the voxels across; and
  /// above it by `above` times as much. It also holds what the blur of a scan and its segmentation
  /// take away, of which labels show nothing. They hide detail, so that most errors have one sign.
  double share;
  double scatters;
  double rest;
  double above;
};

/// Returns the bias of a descriptor; nullptr for descriptors whose bias is not known. Measured by
/// tests/figures/study/resolution_study.py, which prints the table.
const DescriptorBias* bias_of(std::string_view key);

}  // namespace wscvt
