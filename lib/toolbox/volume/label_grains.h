// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "toolbox/volume/label_census.h"
#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/volume_choice.h"
#include "toolbox/volume/voxel_surface.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/option.h"

namespace wscvt {

struct VolumeOptions {
  double background = 0.0;      ///< number between the grains, not a grain; see LabelCoding
  std::int64_t smallest = 100;  ///< voxels of the smallest grain to mesh
  bool at_border = false;       ///< also cut grains at the border of the volume
  int smoothing = 20;           ///< passes, see smoothed_surface
  bool parts = false;           ///< each part of a label is a grain, see volume_parts.h
  /// For a mask: touching grains are separated, see separate_option. The volume is then in memory,
  /// see segmentation.h. Empty: not separated.
  std::optional<double> separate;
  VolumeChoice choice;  ///< the part of the file to read, and the size of its voxels
};

inline constexpr NumberOption<double> background_option = {
    "background", "number of the background", -1e15, 1e15, Ends::Both, "such as 0 or -1, or nan"};
inline constexpr NumberOption<std::int64_t> smallest_option = {
    "smallest", "number of voxels of the smallest grain",
    1,          std::numeric_limits<std::int64_t>::max(),
    Ends::Both, "smaller grains are only listed"};
inline constexpr FlagOption at_border_option = {
    "at-border", "include grains at the border",
    "although it cuts them; without this option they are only listed"};
inline constexpr FlagOption parts_option = {"parts", "make each connected part of a label a grain",
                                            "with a new number; faces of voxels connect a part"};
inline constexpr NumberOption<std::int64_t> channel_option = {"channel", "channel", 1, 1000000};
inline constexpr NumberOption<std::int64_t> frame_option = {"time", "point in time (frame)", 1,
                                                            1000000};
inline constexpr NumberOption<double> voxel_size_option = {"voxel-size", "size of a voxel", 0.0,
                                                           std::numeric_limits<double>::infinity(),
                                                           Ends::NotMinimum};

/// Throws Error(InvalidInput) for options out of range.
void check_volume_options(const VolumeOptions& options);

/// Whether a label becomes a grain.
enum class LabelState { Taken, AtTheBorder, TooSmall };

/// A grain, as a mesh in the volume's coordinates.
struct LabelGrain {
  IndexedMesh mesh;               ///< of the largest piece, pores filled; empty if it is too small
  std::size_t pieces = 0;         ///< of the label
  std::int64_t enclosed = 0;      ///< voxels inside the mesh, which has exactly their volume
  std::int64_t piece_voxels = 0;  ///< of all pieces, pores filled
  std::int64_t pore_voxels = 0;   ///< in the pores of all pieces
};

/// The grains of a volume of labels, one after the other. The volume is read twice: first to find
/// the labels, then for their voxels, slice by slice. Only stretches of voxels of the grains in the
/// current slices are in memory.
class LabelGrains {
 public:
  /// Opens the volume and finds its labels; numbers them anew if the file's numbers are too large
  /// for a label. Throws as open_volume, label_census and check_volume_options do, and
  /// Error(InvalidInput) for a volume without labels.
  LabelGrains(const std::string& path, const VolumeOptions& options, const Execution& execution);

  /// The same for the volume that `open` returns; it may be called twice. `name` is for messages.
  LabelGrains(std::function<std::unique_ptr<LabelVolume>()> open, const std::string& name,
              const VolumeOptions& options, const Execution& execution);

  const VolumeGeometry& geometry() const { return volume_->geometry(); }

  /// See LabelVolume.
  const std::vector<Sentence>& notes() const { return volume_->notes(); }
  const Sentence& description() const { return volume_->description(); }
  /// Those of the volume, and none_taken.
  const std::vector<Sentence>& warnings() const { return warnings_; }

  /// Returns why no label is taken and what to give; empty if one is.
  Sentence none_taken() const;

  /// Returns the file's name of a label; empty if it has none.
  std::string name_of(Label label) const;

  /// Returns the fraction of the voxels of all taken labels that is not meshed: the smaller pieces,
  /// and the largest too if it is below the smallest grain. 1 if no label is taken.
  double left_out() const;

  /// All labels, ascending.
  const std::vector<LabelExtent>& labels() const { return labels_; }
  LabelState state(const LabelExtent& label) const;

  /// Returns the labels that are meshed, as indices into labels(), ordered by their last slices,
  /// then by label.
  const std::vector<std::size_t>& taken() const { return taken_; }

  /// Sets the grains to be read, as ascending indices into taken().
  void want(const std::vector<std::size_t>& grains);

  /// Reads on to the last slice of a wanted grain and makes its mesh. Read the grains in their
  /// order, except grains that several threads work on. Reading a grain again reads the volume from
  /// its beginning. Throws Error as smoothed_surface does, Cancelled, and MachineRefused if the
  /// volume can no longer be read as it was when its labels were found.
  LabelGrain read(std::size_t grain, const Execution& execution);

  /// Returns the labels from their first row on, for a caller that reads all voxels. read() then
  /// starts from the beginning.
  LabelVolume& voxels();

 private:
  void find_labels(bool anew, const Execution& execution);
  std::vector<VoxelStretch> stretches_of(std::size_t grain, const Execution& execution);
  void read_to(std::int32_t slice, const Execution& execution);

  VolumeOptions options_;
  std::vector<Sentence> warnings_;
  std::function<std::unique_ptr<LabelVolume>()> open_;
  std::unique_ptr<LabelVolume> volume_;
  std::vector<LabelExtent> labels_;
  std::vector<std::size_t> taken_;
  std::mutex mutex_;  ///< of the members below
  std::int32_t next_slice_ = 0;
  bool is_behind_ = false;  ///< at_work_ misses stretches of slices before next_slice_
  std::unordered_map<Label, std::vector<VoxelStretch>> at_work_;
};

/// Returns why a label has no mesh; empty if it has one.
std::string refusal_of(const LabelGrain& grain);

/// Returns sentences for the user about a label with several pieces or with pores.
std::vector<std::string> warnings_of(const LabelGrain& grain);

// The table of the labels of a volume: CSV (RFC 4180) with a row per label. Columns:
//   grain           the volume and the label, as in the table of a sample
//   label
//   name            the file's name of the label
//   state           "taken" (it is remeshed), "written", "in N pieces" (the largest is written),
//                   "at the border", "too small" or "failed"
//   error           the message of a failure
//   voxels
//   volume          of the voxels
//   unit            of length, as the file names it
//   x_min to z_max  the box of the voxels
//   pieces          their number
//   left_out        the fraction of voxels outside the largest piece
// and, for a mesh that is written:
//   mesh_volume     of the largest piece, its pores filled
//   vertices, faces, file

/// Result for a label.
struct LabelOutcome {
  const LabelGrain* grain = nullptr;  ///< null if none was made
  std::string file;                   ///< of the mesh; empty if none is written
  std::string error;                  ///< of a failure
};

/// Returns the name of a label's grain.
std::string grain_name(const std::string& volume, Label label);

/// Returns the first record.
std::string label_header();

/// Returns the record of a label.
std::string label_row(const std::string& volume, const LabelGrains& grains,
                      const LabelExtent& label, const LabelOutcome& outcome);

}  // namespace wscvt
