// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "volume/label_census.h"
#include "volume/label_volume.h"
#include "volume/smoothed_surface.h"
#include "volume/voxel_surface.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/option.h"

namespace wscvt {

struct VolumeOptions {
  Label background = 0;         ///< what lies between the grains, which is none
  std::int64_t smallest = 100;  ///< voxels of the smallest grain that is taken
  bool at_border = false;  ///< also grains that touch the border of the volume, cut as they are
  int smoothing = 20;      ///< passes, see smoothed_surface
  bool parts = false;      ///< each part of a label is a grain, see volume_parts.h
  /// Of a mask: grains that touch are parted too, see separate_option; the volume is then held, see
  /// segmentation.h. Nothing: they are not.
  std::optional<double> separate;
  VolumeChoice choice;  ///< what is taken of the file, and the size of its voxels
};

inline constexpr NumberOption<Label> background_option = {"background", "label of the background",
                                                          0, std::numeric_limits<Label>::max()};
inline constexpr NumberOption<std::int64_t> smallest_option = {
    "smallest", "number of voxels of the smallest grain",
    1,          std::numeric_limits<std::int64_t>::max(),
    Ends::Both, "smaller grains are only listed"};
inline constexpr FlagOption at_border_option = {
    "at-border", "include grains at the border",
    "although it cuts them; without this option they are only listed"};
inline constexpr FlagOption parts_option = {"parts", "make each part of a label a grain",
                                            "with a new number; faces of voxels connect a part. In "
                                            "a batch, also make each body of a mesh a grain"};
inline constexpr NumberOption<std::int64_t> channel_option = {
    "channel", "channel of a file that has several", 1, 1000000};
inline constexpr NumberOption<std::int64_t> frame_option = {
    "frame", "frame (point in time) of a file that has several", 1, 1000000};
inline constexpr NumberOption<double> voxel_size_option = {"voxel-size", "size of a voxel", 0.0,
                                                           std::numeric_limits<double>::infinity(),
                                                           Ends::NotMinimum};

/// Throws Error(InvalidInput) for options out of range.
void check_volume_options(const VolumeOptions& options);

/// What becomes of a label.
enum class LabelState { Taken, AtTheBorder, TooSmall };

/// A grain, as a mesh in the volume's coordinates.
struct LabelGrain {
  IndexedMesh mesh;           ///< of the largest piece, pores filled; none where that is too small
  std::size_t pieces = 0;     ///< that the label is in
  std::int64_t enclosed = 0;  ///< voxels inside the mesh, which has exactly their volume
  std::int64_t piece_voxels = 0;  ///< of all pieces, pores filled
  std::int64_t pore_voxels = 0;   ///< in the pores of all pieces
};

/// The grains of a volume of labels, one after the other. The volume is read twice: first to find
/// the labels, then for their voxels, slice by slice; memory is that of the grains that reach into
/// the slices at work, as stretches of voxels.
class LabelGrains {
 public:
  /// Opens the volume and finds its labels. Throws as open_volume, label_census and
  /// check_volume_options do, and Error(InvalidInput) for a volume without labels.
  LabelGrains(const std::string& path, const VolumeOptions& options, const Execution& execution);

  const VolumeGeometry& geometry() const { return volume_->geometry(); }

  /// See LabelVolume.
  const std::vector<std::string>& notes() const { return volume_->notes(); }

  /// What the file calls a label; empty: nothing.
  std::string name_of(Label label) const;

  /// The share of the voxels of all labels that are taken that lies in pieces which are not: of
  /// each the piece with most voxels is, unless it is smaller than the smallest grain.
  double left_out() const;

  /// All labels, ascending.
  const std::vector<LabelExtent>& labels() const { return labels_; }
  LabelState state(const LabelExtent& label) const;

  /// The labels that are taken, by their places in labels(), in the order in which their last
  /// slices come, those of one slice ascending.
  const std::vector<std::size_t>& taken() const { return taken_; }

  /// Says which grains are to be read, by their places in taken(), ascending.
  void want(const std::vector<std::size_t>& grains);

  /// Reads on to the last slice of a wanted grain and makes its mesh: in their order but for those
  /// that several threads work on. A grain may be read again, which reads the volume from its
  /// beginning. Throws Error as smoothed_surface does, Cancelled, and MachineRefused where the
  /// volume cannot be read as it was when its labels were found.
  LabelGrain read(std::size_t grain, const Execution& execution);

 private:
  std::vector<VoxelStretch> stretches_of(std::size_t grain, const Execution& execution);
  void read_to(std::int32_t slice, const Execution& execution);
  void begin_again();

  VolumeOptions options_;
  std::unique_ptr<LabelVolume> volume_;
  std::vector<LabelExtent> labels_;
  std::vector<std::size_t> taken_;
  std::mutex mutex_;  ///< of what follows
  std::int32_t next_slice_ = 0;
  bool is_behind_ = false;  ///< at_work_ misses stretches of slices before next_slice_
  std::unordered_map<Label, std::vector<VoxelStretch>> at_work_;
};

/// What a person has to know of a grain whose label was more than it: sentences.
std::vector<std::string> warnings_of(const LabelGrain& grain);

}  // namespace wscvt
