// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "toolbox/volume/label_census.h"
#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/option.h"

namespace wscvt {

// From grey values, or a mask, to labelled grains. The whole volume is in memory, at most 25 bytes
// per voxel. The result does not depend on the number of threads.

struct SegmentationOptions {
  /// Smallest grey value of material (largest if it is dark); empty: half way between two peaks of
  /// the histogram, see `phases`.
  std::optional<double> threshold;
  /// Number of peaks of the histogram that are material, from the brightest on (from the darkest on
  /// if it is dark); empty: all but one.
  std::optional<int> phases;
  bool dark = false;       ///< the material is darker than the rest
  double separate = 0.85;  ///< see separate_option

  /// Voxels of the smallest grain to keep: a grain of 6 voxels across has no measurable shape.
  std::int64_t smallest = 100;
};

inline constexpr NumberOption<double> threshold_option = {
    "threshold", "smallest grey value of the material", -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity()};
inline constexpr NumberOption<int> phases_option = {
    "phases",
    "number of phases that are material",
    1,
    100,
    Ends::Both,
    "peaks of the grey values, from the brightest on (with --dark from the darkest on). Default: "
    "all but one"};
inline constexpr FlagOption dark_option = {
    "dark", "the material is darker than the rest",
    "The threshold is then the largest grey value of the material"};
inline constexpr NumberOption<double> separate_option = {
    "separate",
    "widest neck between two grains",
    0.0,
    1.0,
    Ends::Both,
    "as a fraction of the smaller one's width (radii of the largest balls inside). Parts with a "
    "wider neck are one grain. Larger values cut more: 0 cuts nowhere, 1 everywhere"};
inline constexpr NumberOption<std::int64_t> smallest_kept_option = {
    "smallest", "number of voxels of the smallest grain",
    1,          std::numeric_limits<std::int64_t>::max(),
    Ends::Both, "smaller grains are dropped"};

/// Two steps of grey values across the surface of grains, such as of a coat, a film or a core.
struct EdgeSteps {
  double space = 0.0;      ///< grey value of the void
  double layer = 0.0;      ///< of a layer at the surface
  double inside = 0.0;     ///< of what is below it
  double thickness = 0.0;  ///< of the layer; voxels; 0: too thin to measure, see film_between
  double fraction = 0.0;   ///< of the surface of all grains, 0 to 1

  /// The grey values go on from the void beyond the layer; otherwise they turn back.
  bool goes_on() const { return (layer > space) == (inside > layer); }

  /// Enough of the surface has them to be told.
  bool are_told() const { return fraction >= 0.1; }
};

/// Grey values that were probably cut off when the scan was saved.
struct CutOffGreys {
  /// Of the voxels of the darker side, the fraction that has the least grey value, and of the
  /// brighter side, that has the largest; 0: not cut off there.
  double least = 0.0;
  double largest = 0.0;
  bool has_edges = false;  ///< middle values lie at edges, not in bodies as in labels
};

/// Result of segment.
struct Segmentation {
  /// Grains from 1, each of one part, in the order in which they begin; 0 between them; dropped
  /// parts have the number of grains plus 1. Readable repeatedly, see LabelVolume.
  std::unique_ptr<LabelVolume> labels;
  std::vector<LabelExtent> grains;  ///< by their labels
  bool is_mask = false;             ///< not smoothed, no threshold computed; see segment
  bool is_flat = false;             ///< most neighbours are equal, as in a volume of labels
  bool is_dark = false;             ///< as in the options
  bool is_chosen = false;           ///< the options have a threshold or a number of phases
  double threshold = 0.0;           ///< as used
  std::vector<double> peaks;        ///< grey values of the histogram's peaks; empty for a mask
  /// Grey values of the void in parts of the volume, the least and the largest but for few, if they
  /// differ by much of the contrast; else 0.
  double darkest_space = 0.0;
  double brightest_space = 0.0;
  CutOffGreys cut_off;
  double blur = 0.0;  ///< of the edges at the threshold, a standard deviation, voxels
  /// Of grains whose grey values go on beyond a layer, and of those that turn back; empty: none.
  std::vector<EdgeSteps> steps;
  bool has_fringes = false;       ///< see EdgeLayers; then without steps
  int medians = 1;                ///< so often the grey values were smoothed; more for noise
  std::uint64_t not_scanned = 0;  ///< voxels outside of what was scanned, see not_scanned
  std::uint64_t wall = 0;         ///< voxels of the wall of a container, which is no material
  std::size_t cut = 0;            ///< grains that touch them; not among `grains`
  std::uint64_t voxels = 0;       ///< of the volume
  std::uint64_t material = 0;     ///< voxels of grains, including dropped ones
  std::uint64_t dropped = 0;      ///< voxels of grains smaller than the smallest
  std::uint64_t filled = 0;       ///< voxels of holes, which count as material
  /// Islands of the material minus holes in it, over all slices along the three axes, as a fraction
  /// of the slices that the grains take: 1 of separate convex grains, .3 to .8 of packings, as much
  /// below 0 of the space between them.
  double island_fraction = 0.0;
  /// Of the grains, the fraction that touches a larger one over a neck of more than .7 of their own
  /// width (see separate_option): where they end is not certain. About half of pieces of porous or
  /// thin grains, and of cemented grains.
  double wide_neck_fraction = 0.0;
  /// Slices along z, from 0, that have one grey value and cut grains: lost ones. None of a mask.
  std::vector<std::size_t> cutting_slices;
};

/// Grains that touch voxels that were not scanned (see segmentation_steps.h) are cut. They are left
/// out as the dropped ones are, because a file of labels cannot tell them from whole ones.
///
/// Segments a scan, which gives grey values from then on (see LabelVolume) and may be read again:
/// the median of each voxel and its 26 neighbours, again if noise leaves one peak, the threshold
/// with a correction of the blur (see level_mask), the wall of a container left out (see
/// segmentation_steps.h), unless a threshold is given the surface of each grain half way to its own
/// grey value (see even_contrast), holes in the material filled, touching parts separated. A
/// volume of two values is a mask; the larger value is the material, or the smaller one if it is
/// dark. So is one of a value and NaN, which is void, and one of up to eight values, most of them
/// equal to their neighbours', if the options have a threshold or a number of phases. Throws Error:
/// InvalidInput for options out of range, without ITK, for a volume of one value, and if no grain
/// is left; Cancelled, and what the volume throws.
Segmentation segment(LabelVolume& scan, const SegmentationOptions& options,
                     const Execution& execution);

/// Separates touching grains of a mask, all that is not background, as segment does. Returns its
/// parts with labels from 1, without dropping any. Throws as segment does, and for a volume of
/// several labels.
std::unique_ptr<LabelVolume> separated(LabelVolume& mask, Label background, double neck,
                                       const Execution& execution);

}  // namespace wscvt
