// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/voxel_type.h"

namespace wscvt {

/// Finds out whether the bytes of a volume's numbers are in the other order than its header says.
/// Neighbours differ far less in the right order, and its floats have usual magnitudes. It looks at
/// 4096 rows at most: 2 % of the instructions of `extract` for 256^3 voxels. Numbers of one byte
/// are never wrong.
class ByteOrderCheck {
 public:
  ByteOrderCheck(const VoxelType& type, const VoxelCounts& counts);

  /// Takes row number `row`, from 0, if it is one of those to look at. `bytes` are the voxels along
  /// x, in the order of the header.
  void look_at(const char* bytes, std::int64_t row) {
    if (type_.bytes > 1 && !is_finished_ && row % step_ == 0) take(bytes);
  }

  /// Takes a row in any case.
  void take(const char* bytes);

  /// Returns whether the rows so far are of the other order. Numbers of 16 bits which are all
  /// multiples of 256 may be labels of either order: they are not accused.
  bool is_swapped() const;

  /// Throws Error(InputOutput), naming the file, if it is.
  void refuse_swapped(const std::string& path) const;

  /// Tells, once all rows were looked at: grey values in the wrong order are noise and refused as
  /// above, labels have the right grains but wrong numbers and get a warning. Then the check rests.
  void finish(LabelVolume& volume, bool as_grey, const std::string& path);

 private:
  template <class Value>
  void take_values(const char* bytes);

  VoxelType type_;
  std::int64_t width_;
  std::int64_t step_;
  /// Sums over neighbours along x of how far they differ, as the header says and in the other
  /// order.
  double differences_ = 0.0;
  double swapped_differences_ = 0.0;
  std::set<std::uint64_t> values_ = {};  ///< the first values other than 0
  bool has_low_bytes_ = false;           ///< their least significant bytes differ
  std::int64_t floats_ = 0;              ///< other than 0
  std::int64_t odd_ = 0;                 ///< floats of no usual magnitude
  std::int64_t swapped_odd_ = 0;
  bool is_finished_ = false;
};

}  // namespace wscvt
