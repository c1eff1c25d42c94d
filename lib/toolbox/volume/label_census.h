// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// A label and the position of its voxels.
struct LabelExtent {
  Label label = 0;
  std::uint64_t voxels = 0;
  VoxelCounts begin = {};           ///< its first voxel along each axis
  VoxelCounts end = {};             ///< one after its last
  std::size_t pieces = 0;           ///< of the label, connected by faces of voxels
  std::uint64_t largest_piece = 0;  ///< voxels of the largest piece

  /// Returns the fraction of voxels outside the largest piece.
  double left_out() const {
    return 1.0 - static_cast<double>(largest_piece) / static_cast<double>(voxels);
  }
  bool touches_border(const VoxelCounts& counts) const;
};

/// Largest number of labels of a volume. A grey image mistaken for labels has more.
inline constexpr std::size_t most_labels = 1000000;

/// Tells grey values from labels: noise makes most neighbours differ, but a grain of labels has
/// neighbours inside. Counts neighbours along x and along y that are both not the background.
class GreyCheck {
 public:
  explicit GreyCheck(Label background) : background_(background) {}
  void add_row(const std::vector<Label>& row, std::int32_t y);

  /// Throws Error(InvalidInput) if of enough neighbours more than half differ along both axes. To
  /// be called after each slice: grey values of 16 bits have more pairs of neighbours than memory
  /// has room for.
  void end_slice() const { check(100000); }
  void end() const { check(1000); }

 private:
  struct Neighbours {
    std::uint64_t all = 0;
    std::uint64_t different = 0;
    void count(const Label* a, const Label* b, std::size_t size, Label background);
    double fraction() const { return static_cast<double>(different) / static_cast<double>(all); }
  };
  void check(std::uint64_t fewest) const;

  Label background_;
  std::vector<Label> before_;  ///< the row before
  Neighbours along_x_;
  Neighbours along_y_;
};

/// Reads the volume once from its beginning, and returns its labels without the background, in
/// their order, with the number of pieces of each. Needs memory for the labels and the stretches of
/// two slices. Throws Error: InvalidInput for more than `most_labels` and for grey values, see
/// GreyCheck, Cancelled, and what the volume throws.
std::vector<LabelExtent> label_census(LabelVolume& volume, Label background,
                                      const Execution& execution);

}  // namespace wscvt
