// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
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

/// Calls visit(zero) with a number of the type in C++.
template <class Visit>
void visit_number_type(const VoxelType& type, const Visit& visit) {
  const auto visit_whole = [&](auto with_sign, auto without_sign) {
    if (type.has_sign) return visit(with_sign);
    visit(without_sign);
  };
  if (type.is_float) return type.bytes == 4 ? visit(float{}) : visit(double{});
  if (type.bytes == 1) return visit_whole(std::int8_t{}, std::uint8_t{});
  if (type.bytes == 2) return visit_whole(std::int16_t{}, std::uint16_t{});
  if (type.bytes == 4) return visit_whole(std::int32_t{}, std::uint32_t{});
  visit_whole(std::int64_t{}, std::uint64_t{});
}

/// Returns the type for such a name, or nothing for other names.
std::optional<VoxelType> known_voxel_type(std::string_view name);

/// Returns the type for a name in NRRD, MetaImage, VTK or a raw file's description ("unsigned
/// short", "MET_USHORT", "UInt16", "float", ...), in either case; its byte order is little-endian.
/// Throws Error(InputOutput), naming the file `path`, for other names.
VoxelType voxel_type_of(std::string_view name, const std::string& path);

}  // namespace wscvt
