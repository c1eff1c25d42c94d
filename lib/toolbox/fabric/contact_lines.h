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

/// Returns the standard deviation of the blur of a scan, that of its voxels included, from its grey
/// values along lines from the inside of a label to the void; length. `scan` gives grey values from
/// then on. Reads both volumes once.
///
/// A profile v, 1 in the grain and 0 in the void, is an error function, stretched by 1 / |n| along
/// a line that is inclined to the normal: the integral of v (1 - v) is s / (sqrt(pi) |n|). Among
/// the lines that cross a surface of all directions, half have |n| above sqrt(1/2). The median over
/// the lines along the first two axes therefore gives s.
///
/// Throws Error: InvalidInput if the volumes have different counts or known sizes of voxels, if
/// less than 100 lines cross an edge with six voxels of a label and six of void on its sides, or if
/// both sides have the same grey values; Cancelled, and what the volumes throw.
double edge_width(LabelVolume& labels, Label background, LabelVolume& scan,
                  const Execution& execution);

}  // namespace wscvt
