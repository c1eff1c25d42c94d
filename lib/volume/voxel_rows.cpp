// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/voxel_rows.h"

#include <algorithm>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <type_traits>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/scan/byte_reader.h"
#include "wscvt/scan/text_fields.h"

namespace wscvt {

namespace {

/// All names of one type.
struct TypeNames {
  int bytes;
  bool has_sign;
  std::vector<std::string_view> names;
};

const std::vector<TypeNames>& type_names() {
  static const std::vector<TypeNames> rows = {
      {1, false, {"uchar", "unsigned char", "uint8", "uint8_t", "met_uchar"}},
      {1, true, {"signed char", "int8", "int8_t", "met_char"}},
      {2,
       false,
       {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t", "met_ushort"}},
      {2,
       true,
       {"short", "short int", "signed short", "signed short int", "int16", "int16_t", "met_short"}},
      {4, false, {"uint", "unsigned int", "uint32", "uint32_t", "met_uint"}},
      {4, true, {"int", "signed int", "int32", "int32_t", "met_int"}},
      {8,
       false,
       {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t",
        "met_ulong_long"}},
      {8,
       true,
       {"longlong", "long long", "long long int", "signed long long", "signed long long int",
        "int64", "int64_t", "met_long_long"}},
  };
  return rows;
}

template <class Value, boost::endian::order Order>
void load_row(const char* bytes, std::vector<Label>& row, const std::string& path) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Value value = load<Value, Order>(bytes + i * sizeof(Value));
    if constexpr (std::numeric_limits<Value>::is_signed || sizeof(Value) > sizeof(Label)) {
      const bool below = std::numeric_limits<Value>::is_signed && value < Value{0};
      if (below || static_cast<std::uint64_t>(value) > std::numeric_limits<Label>::max()) {
        refuse_volume(path, "holds the voxel " + std::to_string(value) +
                                ", and labels are whole numbers from 0 to 4294967295; segment it, "
                                "and save the labels.");
      }
    }
    row[i] = static_cast<Label>(static_cast<std::make_unsigned_t<Value>>(value));
  }
}

template <boost::endian::order Order>
void load_row(const char* bytes, const VoxelType& type, std::vector<Label>& row,
              const std::string& path) {
  const auto load_as = [&](auto with_sign, auto without_sign) {
    if (type.has_sign) return load_row<decltype(with_sign), Order>(bytes, row, path);
    load_row<decltype(without_sign), Order>(bytes, row, path);
  };
  if (type.bytes == 1) return load_as(std::int8_t{}, std::uint8_t{});
  if (type.bytes == 2) return load_as(std::int16_t{}, std::uint16_t{});
  if (type.bytes == 4) return load_as(std::int32_t{}, std::uint32_t{});
  load_as(std::int64_t{}, std::uint64_t{});
}

class VolumeOfBytes : public LabelVolume {
 public:
  VolumeOfBytes(const VolumeGeometry& geometry, const VoxelType& type,
                std::unique_ptr<ByteSource> bytes, std::string path)
      : LabelVolume(geometry), type_(type), bytes_(std::move(bytes)), path_(std::move(path)) {}

  const std::vector<Label>& next_row() override {
    // Made here, not before: a count that a packed file claims falsely is found by then.
    const auto count = static_cast<std::size_t>(geometry().counts[0]);
    row_.resize(count);
    packed_.resize(count * static_cast<std::size_t>(type_.bytes));
    if (bytes_->read(packed_.data(), packed_.size()) < packed_.size()) {
      refuse_volume(path_,
                    "ends before the last voxel that it tells of; copy it again, or export "
                    "it again.");
    }
    labels_of(packed_.data(), type_, row_, path_);
    return row_;
  }

  void rewind() override { bytes_->rewind(); }

 private:
  VoxelType type_;
  std::unique_ptr<ByteSource> bytes_;
  std::string path_;
  std::vector<char> packed_;
  std::vector<Label> row_;
};

}  // namespace

void refuse_volume(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

VoxelType voxel_type_of(std::string_view name, const std::string& path) {
  const std::string lower = lower_case(name);
  for (const TypeNames& row : type_names()) {
    for (const std::string_view known : row.names) {
      if (lower == known) return {row.bytes, row.has_sign, false};
    }
  }
  refuse_volume(path, "holds voxels of type " + in_quotes(name) +
                          ", and labels are whole numbers; save it as 8, 16 or 32 bits without a "
                          "sign.");
}

void labels_of(const char* bytes, const VoxelType& type, std::vector<Label>& row,
               const std::string& path) {
  if (type.big_endian) {
    load_row<boost::endian::order::big>(bytes, type, row, path);
  } else {
    load_row<boost::endian::order::little>(bytes, type, row, path);
  }
}

VoxelCounts voxel_counts(const std::array<std::int64_t, 3>& counts, const std::string& path) {
  constexpr std::int64_t most = 1000000;
  VoxelCounts result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (counts[axis] < 1 || counts[axis] > most) {
      refuse_volume(path, "tells of " + std::to_string(counts[axis]) +
                              " voxels along an axis, where 1 to 1000000 can be; export it again.");
    }
    result[axis] = static_cast<std::int32_t>(counts[axis]);
  }
  return result;
}

std::uint64_t voxel_bytes(const VoxelCounts& counts, const VoxelType& type) {
  auto bytes = static_cast<std::uint64_t>(type.bytes);
  for (const std::int32_t count : counts) bytes *= static_cast<std::uint64_t>(count);
  return bytes;
}

void check_voxel_bytes(const VolumeGeometry& geometry, const VoxelType& type, std::uint64_t left,
                       bool is_packed, const std::string& path) {
  constexpr std::uint64_t most_packed = 1100;  // deflate makes at best one byte of 1032
  const std::uint64_t wanted = voxel_bytes(geometry.counts, type);
  if ((is_packed ? wanted / most_packed : wanted) <= left) return;
  refuse_volume(path, "holds " + std::to_string(left) + " bytes of voxels, and its size asks for " +
                          std::to_string(wanted) + "; copy it again, or export it again.");
}

std::unique_ptr<LabelVolume> volume_of_bytes(const VolumeGeometry& geometry, const VoxelType& type,
                                             std::unique_ptr<ByteSource> bytes,
                                             const std::string& path) {
  return std::make_unique<VolumeOfBytes>(geometry, type, std::move(bytes), path);
}

std::unique_ptr<LabelVolume> volume_of_file(const VolumeGeometry& geometry, const VoxelType& type,
                                            const VoxelData& data) {
  const std::uint64_t size = file_size(data.path);
  const std::uint64_t wanted = voxel_bytes(geometry.counts, type);
  const std::uint64_t offset = data.at_end ? size - std::min(size, wanted) : data.offset;
  check_voxel_bytes(geometry, type, size - std::min(size, offset), data.is_packed, data.path);
  std::unique_ptr<ByteSource> bytes = file_bytes(data.path, offset);
  if (data.is_packed) bytes = inflated_bytes(std::move(bytes), data.path);
  return volume_of_bytes(geometry, type, std::move(bytes), data.path);
}

std::string voxel_file_beside(const std::string& header, const std::string& name) {
  // A NUL would end it, and name another file.
  if (std::any_of(name.begin(), name.end(),
                  [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; })) {
    refuse_volume(header, "names the file " + in_quotes(name) +
                              " for its voxels, and there are control characters in that; correct "
                              "it.");
  }
  if (name.empty() || name.find('%') != std::string::npos ||
      lower_case(name).rfind("list", 0) == 0) {
    refuse_volume(header, "names more than one file of voxels, or none; save it in one.");
  }
  const std::filesystem::path path(name);
  return path.is_absolute()
             ? name
             : (std::filesystem::path(header).parent_path() / path).lexically_normal().string();
}

LabelVolume::LabelVolume(VolumeGeometry geometry) : geometry_(std::move(geometry)) {}

double VolumeGeometry::voxel_volume() const { return std::abs(axes.determinant()); }

}  // namespace wscvt
