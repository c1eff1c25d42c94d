// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "volume/byte_source.h"
#include "volume/label_volume.h"
#include "volume/volume_choice.h"

namespace wscvt {

/// Numbers as a file holds them.
struct VoxelType {
  int bytes = 1;  ///< 1, 2, 4 or 8; of floats 4 or 8
  bool has_sign = false;
  bool is_float = false;
  bool big_endian = false;
};

/// Of the names that NRRD, MetaImage, VTK and NumPy have for numbers ("unsigned short",
/// "MET_USHORT", "UInt16", "uint16", "float", ...), in either case; its byte order is
/// little-endian. Nothing for other names.
std::optional<VoxelType> known_voxel_type(std::string_view name);

/// The same. Throws Error(InputOutput) naming the file `path` for other names.
VoxelType voxel_type_of(std::string_view name, const std::string& path);

/// Where a row of voxels stands, for sentences.
struct RowPlace {
  const std::string& path;
  std::int64_t y = 0;
  std::int64_t z = 0;
};

/// Makes labels of a row of voxels, or codes of grey values. Floats are labels where they are whole
/// numbers. Throws Error(InputOutput), naming the file and the voxel, for numbers that are no
/// labels.
void labels_of(const char* bytes, const VoxelType& type, bool as_grey, std::vector<Label>& row,
               const RowPlace& place);

/// Counts of voxels as a file claims them. Throws Error(InputOutput), naming the file `path`, when
/// one is below 1 or above a million.
VoxelCounts voxel_counts(const std::array<std::int64_t, 3>& counts, const std::string& path);

/// Bytes that all voxels of a volume take.
std::uint64_t voxel_bytes(const VoxelCounts& counts, const VoxelType& type);

/// How voxels are packed.
enum class Packing {
  None,
  Deflate,  ///< gzip or zlib
  Bzip2,
  Text  ///< numbers as they are printed; they become doubles
};

/// Where the voxels of a volume stand, in their order, x fastest.
struct VoxelData {
  std::vector<std::string> paths;  ///< one behind the other, all with as many bytes
  std::uint64_t offset = 0;        ///< of each
  Packing packing = Packing::None;
  /// They are the end of the file, whatever stands before them in place of `offset`; not packed.
  bool at_end = false;
  std::vector<BlockPick> picks = {};  ///< what is taken of them, in voxels
  bool has_more = false;              ///< other things stand behind them
};

/// The labels of files that hold nothing else in their order. A file that holds more than it says
/// is noted, and one that holds twice as much is refused. Throws Error(InputOutput) when a file
/// cannot be opened or is too short.
std::unique_ptr<LabelVolume> volume_of_files(const VolumeGeometry& geometry, VoxelType type,
                                             const VoxelData& data);

/// Throws Error(InputOutput) when fewer than the bytes `wanted` are there: `left` of the file
/// `path`; of packed ones only what no packing can make smaller is held against it.
void check_voxel_bytes(std::uint64_t wanted, std::uint64_t left, Packing packing,
                       const std::string& path);

/// The labels of a format that is a header and voxels in their order. `path` is for sentences.
std::unique_ptr<LabelVolume> volume_of_bytes(const VolumeGeometry& geometry, const VoxelType& type,
                                             std::unique_ptr<ByteSource> bytes,
                                             const std::string& path);

/// What is taken of `bytes`, voxel after voxel of `voxel` bytes.
std::unique_ptr<ByteSource> picked_voxels(std::unique_ptr<ByteSource> bytes,
                                          const std::vector<BlockPick>& picks, std::uint64_t voxel);

/// Throws Error(InputOutput) that says the file is no such volume: "path" + what, and what to do.
[[noreturn]] void refuse_volume(const std::string& path, const std::string& what);

/// The file that a header names for its voxels, beside it. Throws Error(InputOutput) for an empty
/// name.
std::string voxel_file_beside(const std::string& header, const std::string& name);

/// The files of a pattern of C, "s_%03d.raw", and its first number, last number and step, beside a
/// header. Throws Error(InputOutput) for a pattern of another form than one whole number in the
/// name, and for more files than a volume has slices.
std::vector<std::string> voxel_files_beside(const std::string& header, const std::string& pattern,
                                            std::int64_t first, std::int64_t last,
                                            std::int64_t step);

}  // namespace wscvt
