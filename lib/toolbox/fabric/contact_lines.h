// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

// Counts where lines of voxels go from one label to another, through no voxel of the background or
// a few. All sums are whole numbers, so the order of the voxels changes no bit.

/// Widest gap that is counted, voxels.
inline constexpr std::size_t widest_gap = 4;

/// A point in half voxels: the middle of voxel i is at 2 i + 1.
using HalfVoxels = std::array<std::int64_t, 3>;

/// Sums over points, about an origin near to them.
struct PointSums {
  std::int64_t count = 0;
  HalfVoxels sum = {};
  std::array<std::int64_t, 6> products = {};  ///< xx, yy, zz, xy, xz, yz

  void add(const HalfVoxels& offset);
  PointSums& operator+=(const PointSums& other);
};

/// Two labels that are near each other.
struct LabelPair {
  std::size_t first = 0;   ///< index of the smaller label
  std::size_t second = 0;  ///< index of the larger one
  /// By the width of the gap, voxels, and the axis: lines along the axis from the first label to
  /// the second minus lines from the second to the first.
  std::array<std::array<std::int64_t, 3>, widest_gap + 1> lines = {};
  HalfVoxels origin = {};
  std::array<std::int64_t, 3> faces_across = {};  ///< faces between the two across each axis
  PointSums faces;                                ///< their middles
  PointSums beside;                               ///< middles of the gaps of one voxel
  PointSums around;                               ///< middles of all gaps
};

/// A label and sums over its voxels.
struct LabelSums {
  Label label = 0;
  std::uint64_t voxels = 0;
  HalfVoxels middles = {};  ///< sum of the voxels' middles
  bool at_border = false;
};

struct ContactLines {
  std::vector<LabelSums> labels;  ///< ascending
  std::vector<LabelPair> pairs;   ///< that share a face, by their labels
};

/// Reads the volume once from its beginning. Throws Error: InvalidInput for more than a million
/// labels, Cancelled, and what the volume throws.
ContactLines contact_lines(LabelVolume& volume, Label background, const Execution& execution);

}  // namespace wscvt
