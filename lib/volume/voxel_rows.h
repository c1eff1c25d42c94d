// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "volume/byte_source.h"
#include "volume/label_volume.h"

namespace wscvt {

/// Whole numbers as a file holds them.
struct VoxelType {
  int bytes = 1;  ///< 1, 2, 4 or 8
  bool has_sign = false;
  bool big_endian = false;
};

/// Of the names that NRRD, MetaImage, VTK and NumPy have for whole numbers ("unsigned short",
/// "MET_USHORT", "UInt16", "uint16", ...), in either case; its byte order is little-endian. Throws
/// Error(InputOutput) naming the file `path`, when it is another: labels have no decimals.
VoxelType voxel_type_of(std::string_view name, const std::string& path);

/// Makes labels of a row of voxels. Throws Error(InputOutput), naming the file `path`, for numbers
/// that are no labels.
void labels_of(const char* bytes, const VoxelType& type, std::vector<Label>& row,
               const std::string& path);

/// Counts of voxels as a file claims them. Throws Error(InputOutput), naming the file `path`, when
/// one is below 1 or above a million.
VoxelCounts voxel_counts(const std::array<std::int64_t, 3>& counts, const std::string& path);

/// Bytes that all voxels of a volume take.
std::uint64_t voxel_bytes(const VoxelCounts& counts, const VoxelType& type);

/// Where the voxels of a volume stand in a file, in their order.
struct VoxelData {
  std::string path;
  std::uint64_t offset = 0;
  bool is_packed = false;  ///< by gzip or zlib
  /// They are the end of the file, whatever stands before them in place of `offset`; not packed.
  bool at_end = false;
};

/// The labels of a file that holds nothing else in their order. Throws Error(InputOutput) when it
/// cannot be opened or is too short.
std::unique_ptr<LabelVolume> volume_of_file(const VolumeGeometry& geometry, const VoxelType& type,
                                            const VoxelData& data);

/// Throws Error(InputOutput) when fewer than the bytes of all voxels are there: `left` of the file
/// `path`; of packed ones only what no packing can make smaller is held against it.
void check_voxel_bytes(const VolumeGeometry& geometry, const VoxelType& type, std::uint64_t left,
                       bool is_packed, const std::string& path);

/// The labels of a format that is a header and voxels in their order. `path` is for sentences.
std::unique_ptr<LabelVolume> volume_of_bytes(const VolumeGeometry& geometry, const VoxelType& type,
                                             std::unique_ptr<ByteSource> bytes,
                                             const std::string& path);

/// Throws Error(InputOutput) that says the file is no such volume: "path" + what, and what to do.
[[noreturn]] void refuse_volume(const std::string& path, const std::string& what);

/// The file that a header names for its voxels, beside it. Throws Error(InputOutput) for names of
/// more than one file, which some formats have.
std::string voxel_file_beside(const std::string& header, const std::string& name);

}  // namespace wscvt
