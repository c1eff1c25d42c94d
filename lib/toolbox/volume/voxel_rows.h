// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/volume_choice.h"
#include "toolbox/volume/voxel_bytes.h"
#include "toolbox/volume/voxel_type.h"

namespace wscvt {

/// Position of a row of voxels, for messages.
struct RowPlace {
  const std::string& path;
  std::int64_t y = 0;
  std::int64_t z = 0;
};

/// Converts a row of voxels to labels, or to codes of grey values, see LabelCoding. Floats are
/// labels if they are whole numbers. Throws Error(InputOutput), naming the file and the voxel, for
/// numbers that are no labels, and LargeNumber.
void labels_of(const char* bytes, const VoxelType& type, LabelCoding& coding,
               std::vector<Label>& row, const RowPlace& place);

/// Throws Error(InputOutput), naming the file, if the three colours of a voxel, of `size` bytes
/// each, differ.
void check_colours_equal(const char* colours, std::size_t size, const std::string& path);

/// Throws that error.
[[noreturn]] void refuse_colours(const std::string& path);

/// Checks the counts of voxels in a file. Throws Error(InputOutput), naming the file `path`, if one
/// is below 1 or above a million.
VoxelCounts voxel_counts(const std::array<std::int64_t, 3>& counts, const std::string& path);

/// Returns the number of bytes of the voxels from which a volume is selected.
std::uint64_t stored_bytes(const VoxelCounts& counts, const VoxelType& type,
                           const std::vector<BlockPick>& picks);

/// Compression or encoding of voxels.
enum class Packing {
  None,
  Deflate,  ///< gzip or zlib
  Text      ///< printed numbers; they become doubles
};

/// Position of the voxels of a volume, in their order, x fastest.
struct VoxelData {
  std::vector<std::string> paths;  ///< one after the other, all with equally many bytes
  std::uint64_t offset = 0;        ///< of each
  Packing packing = Packing::None;
  /// They are the end of the file, whatever precedes them; replaces `offset`; not packed.
  bool at_end = false;
  std::vector<BlockPick> picks = {};  ///< selection, in voxels
  bool has_more = false;              ///< other data follow them
};

/// Opens files that contain only labels in their order. If a file has more bytes than it says, this
/// is noted; with twice as many it is refused. Throws Error(InputOutput) if a file cannot be opened
/// or is too short.
std::unique_ptr<LabelVolume> volume_of_files(const VolumeGeometry& geometry, VoxelType type,
                                             const VoxelData& data);

/// Throws Error(InputOutput) if `left`, the bytes left in the file `path`, are fewer than `wanted`.
/// For packed voxels, only if no packing could make them so small.
void check_voxel_bytes(std::uint64_t wanted, std::uint64_t left, Packing packing,
                       const std::string& path);

/// Opens a format that is a header and voxels in their order. `open` returns the voxels' bytes, of
/// which `picks` select the volume. `path` is for messages.
std::unique_ptr<LabelVolume> volume_of_bytes(const VolumeGeometry& geometry, const VoxelType& type,
                                             const std::vector<BlockPick>& picks, OpenBytes open,
                                             const std::string& path);

/// Returns the file beside a header that the header names for its voxels. Throws Error(InputOutput)
/// for an empty name.
std::string voxel_file_beside(const std::string& header, const std::string& name);

/// Returns the files that a header names for its voxels: one file, those of `list` if `named` is
/// "LIST", or those of a pattern of C with its first number, last number and step, "s_%03d.raw 1 24
/// 1". `numbers`: what counts if numbers are left out; empty: none may be. Throws
/// Error(InputOutput) for a pattern without exactly one whole number, and for more files than a
/// volume has slices.
std::vector<std::string> voxel_files_beside(const std::string& header, const std::string& named,
                                            const std::vector<std::string>& list,
                                            std::optional<std::array<std::int64_t, 3>> numbers);

/// Throws Error(InputOutput) unless a header has as many sizes as it says, and more than two.
void check_dimensions(std::int64_t said, std::size_t sizes, const std::string& header);

}  // namespace wscvt
