// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace wscvt {

/// Type of the numbers in a file.
struct VoxelType {
  int bytes = 1;  ///< 1, 2, 4 or 8; 4 or 8 for floats
  bool has_sign = false;
  bool is_float = false;
  bool big_endian = false;
};

/// Returns the type for such a name, or nothing for other names.
std::optional<VoxelType> known_voxel_type(std::string_view name);

/// Returns the type for a name in NRRD, MetaImage, VTK or a raw file's description ("unsigned
/// short", "MET_USHORT", "UInt16", "float", ...), in either case; its byte order is little-endian.
/// Throws Error(InputOutput), naming the file `path`, for other names.
VoxelType voxel_type_of(std::string_view name, const std::string& path);

}  // namespace wscvt
