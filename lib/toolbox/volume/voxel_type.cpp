// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/voxel_type.h"

#include <algorithm>
#include <vector>

#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

/// All names of a type.
struct TypeNames {
  VoxelType type;
  std::vector<std::string_view> names;
};

const std::vector<TypeNames>& type_names() {
  static const std::vector<TypeNames> rows = {
      {{1, false, false}, {"uchar", "unsigned char", "uint8", "uint8_t", "met_uchar"}},
      {{1, true, false}, {"signed char", "int8", "int8_t", "met_char"}},
      {{2, false, false},
       {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t", "met_ushort"}},
      {{2, true, false},
       {"short", "short int", "signed short", "signed short int", "int16", "int16_t", "met_short"}},
      // MetaIO's long has four bytes on every machine.
      {{4, false, false}, {"uint", "unsigned int", "uint32", "uint32_t", "met_uint", "met_ulong"}},
      {{4, true, false}, {"int", "signed int", "int32", "int32_t", "met_int", "met_long"}},
      {{8, false, false},
       {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t",
        "met_ulong_long"}},
      {{8, true, false},
       {"longlong", "long long", "long long int", "signed long long", "signed long long int",
        "int64", "int64_t", "met_long_long"}},
      {{4, true, true}, {"float", "float32", "met_float"}},
      {{8, true, true}, {"double", "float64", "met_double"}},
  };
  return rows;
}

}  // namespace

std::optional<VoxelType> known_voxel_type(std::string_view name) {
  const std::string lower = lower_case(name);
  for (const TypeNames& row : type_names()) {
    if (std::find(row.names.begin(), row.names.end(), lower) != row.names.end()) return row.type;
  }
  return std::nullopt;
}

VoxelType voxel_type_of(std::string_view name, const std::string& path) {
  if (const std::optional<VoxelType> type = known_voxel_type(name)) return *type;
  refuse_volume(path, "holds voxels of type " + in_quotes(name) +
                          ", but labels are whole numbers. Save it as 8, 16 or 32 bits without a "
                          "sign.");
}

}  // namespace wscvt
