// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "volume/label_census.h"
#include "volume/label_volume.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/option.h"

namespace wscvt {

// From grey values, or a mask, to labelled grains. All of a volume is held, 25 bytes a voxel at the
// most; the result is the same on any number of threads.

struct SegmentationOptions {
  /// The grey value from which on a voxel is material; empty: see level_between_peaks.
  std::optional<double> threshold;
  /// See separate_option; a voxel's edge is the cube root of its volume. Steps of voxels make false
  /// maxima of up to half a voxel, and true necks of grains in contact begin a little above that.
  double separate = 0.75;
  /// Voxels of the smallest grain that is kept: what is 6 voxels across has no shape to measure.
  std::int64_t smallest = 100;
};

inline constexpr NumberOption<double> threshold_option = {
    "threshold", "smallest grey value of the material", -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity()};
inline constexpr NumberOption<double> separate_option = {
    "separate",
    "depth of the neck between two grains",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::Neither,
    "in voxels. It says how much closer to the surface the neck's middle is than the smaller "
    "grain's middle. Larger values join parts, smaller values cut them"};
inline constexpr NumberOption<std::int64_t> smallest_kept_option = {
    "smallest", "number of voxels of the smallest grain",
    1,          std::numeric_limits<std::int64_t>::max(),
    Ends::Both, "smaller grains are dropped"};

/// What came of a volume.
struct Segmentation {
  /// Grains from 1, each of one part, in the order in which they begin; 0 between them; one more
  /// than grains where parts were dropped. May be read as often as wanted, see LabelVolume.
  std::unique_ptr<LabelVolume> labels;
  std::vector<LabelExtent> grains;  ///< by their labels
  bool is_mask = false;             ///< it has two values, and was neither smoothed nor parted
  bool is_flat = false;             ///< most neighbours are equal, as in a volume of labels
  double threshold = 0.0;           ///< that was taken
  std::uint64_t voxels = 0;         ///< of the volume
  std::uint64_t material = 0;       ///< voxels of grains, those that were dropped too
  std::uint64_t dropped = 0;        ///< voxels of grains smaller than the smallest
  std::uint64_t filled = 0;         ///< voxels of holes, which count as material
};

/// Reads a scan, which gives grey values from then on (see LabelVolume) and may be read again: the
/// median of each voxel and its 26 neighbours; the threshold; holes inside the material filled; its
/// parts separated. A volume of two values is a mask, whose larger value is the material. Throws
/// Error: InvalidInput for options out of range, without ITK, for a volume of one value, and where
/// no grain is left; Cancelled, and what the volume throws.
Segmentation segment(LabelVolume& scan, const SegmentationOptions& options,
                     const Execution& execution);

/// The parts of a mask, all that is not background, as grains that touch are separated by segment:
/// labels from 1, none left out. Throws as segment does, and for a volume of several labels.
std::unique_ptr<LabelVolume> separated(LabelVolume& mask, Label background, double depth,
                                       const Execution& execution);

}  // namespace wscvt
