// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// A label and where its voxels are.
struct LabelExtent {
  Label label = 0;
  std::uint64_t voxels = 0;
  VoxelCounts begin = {};           ///< its first voxel along each axis
  VoxelCounts end = {};             ///< one behind its last
  std::size_t pieces = 0;           ///< that it is in, which hang together by faces of voxels
  std::uint64_t largest_piece = 0;  ///< voxels of the one that has most

  /// The share of its voxels that are not in that piece.
  double left_out() const {
    return 1.0 - static_cast<double>(largest_piece) / static_cast<double>(voxels);
  }
  bool touches_border(const VoxelCounts& counts) const;
};

/// The largest number of labels that a volume may have: a grey image, taken for labels, has more.
inline constexpr std::size_t most_labels = 1000000;

/// Calls visit(label, y, z, begin, end) for every stretch of one label along x, in the order of the
/// file; returns early where visit gives false.
template <class Visit>
bool visit_stretches(const std::vector<Label>& row, std::int32_t y, std::int32_t z,
                     const Visit& visit) {
  const auto count = static_cast<std::int32_t>(row.size());
  for (std::int32_t begin = 0; begin < count;) {
    const Label label = row[static_cast<std::size_t>(begin)];
    std::int32_t end = begin + 1;
    while (end < count && row[static_cast<std::size_t>(end)] == label) ++end;
    if (!visit(label, y, z, begin, end)) return false;
    begin = end;
  }
  return true;
}

/// Reads the volume once, from its beginning, and finds its labels but for the background, in their
/// order, and how many pieces each is in. Memory is that of two slices' stretches and of the
/// labels. Throws Error: InvalidInput for more than `most_labels`, Cancelled, and what the volume
/// throws.
std::vector<LabelExtent> label_census(LabelVolume& volume, Label background,
                                      const Execution& execution);

}  // namespace wscvt
