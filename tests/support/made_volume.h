// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/coded_bytes.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt::test {

/// A volume of labels that a test makes, x running fastest.
struct MadeVolume {
  explicit MadeVolume(std::array<int, 3> size)
      : counts(size), labels(static_cast<std::size_t>(size[0]) * size[1] * size[2], 0) {}

  std::uint32_t& at(int x, int y, int z) {
    return labels[(static_cast<std::size_t>(z) * counts[1] + y) * counts[0] + x];
  }

  /// Voxels whose middles `is_inside` holds, lattice coordinates, get the label; says how many. It
  /// holds none outside of the box from `least` to `most`.
  template <class Inside>
  std::int64_t fill_within(std::uint32_t label, const Vector3& least, const Vector3& most,
                           const Inside& is_inside) {
    std::array<int, 3> begin{}, end{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      begin[k] = static_cast<int>(
          std::clamp(std::floor(least[axis]), 0.0, static_cast<double>(counts[k])));
      end[k] =
          static_cast<int>(std::clamp(std::ceil(most[axis]), 0.0, static_cast<double>(counts[k])));
    }
    std::int64_t count = 0;
    for (int z = begin[2]; z < end[2]; ++z) {
      for (int y = begin[1]; y < end[1]; ++y) {
        for (int x = begin[0]; x < end[0]; ++x) {
          if (!is_inside(Vector3(x + 0.5, y + 0.5, z + 0.5))) continue;
          at(x, y, z) = label;
          ++count;
        }
      }
    }
    return count;
  }
  template <class Inside>
  std::int64_t fill(std::uint32_t label, const Inside& is_inside) {
    const Vector3 whole(counts[0], counts[1], counts[2]);
    return fill_within(label, Vector3::Zero(), whole, is_inside);
  }
  std::int64_t fill_ball(std::uint32_t label, const Vector3& middle, double radius) {
    return fill_within(label, middle.array() - radius, middle.array() + radius,
                       [&](const Vector3& p) { return (p - middle).norm() < radius; });
  }
  std::int64_t fill_box(std::uint32_t label, const Vector3& least, const Vector3& most) {
    return fill_within(label, least, most, [&](const Vector3& p) {
      return (p - least).minCoeff() > 0.0 && (most - p).minCoeff() > 0.0;
    });
  }

  /// Gives each voxel the value at its place, counted from 0, without decimals.
  template <class ValueAt>
  void set(const ValueAt& value_at) {
    for (int z = 0; z < counts[2]; ++z) {
      for (int y = 0; y < counts[1]; ++y) {
        for (int x = 0; x < counts[0]; ++x) {
          at(x, y, z) = static_cast<std::uint32_t>(value_at(Vector3(x, y, z)));
        }
      }
    }
  }

  /// The labels as whole numbers of a type.
  template <class Value>
  std::string bytes(bool big_endian = false) const {
    std::string text;
    text.reserve(labels.size() * sizeof(Value));
    for (const std::uint32_t label : labels) {
      const auto value = static_cast<std::uint64_t>(static_cast<Value>(label));
      for (std::size_t k = 0; k < sizeof(Value); ++k) {
        const std::size_t place = big_endian ? sizeof(Value) - 1 - k : k;
        text += static_cast<char>(value >> (8 * place) & 0xffU);
      }
    }
    return text;
  }

  std::string size_text() const {
    return std::to_string(counts[0]) + " " + std::to_string(counts[1]) + " " +
           std::to_string(counts[2]);
  }

  std::array<int, 3> counts;
  std::vector<std::uint32_t> labels;
};

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A zlib stream, or one of gzip.
inline std::string packed(const std::string& bytes, bool is_gzip) {
  z_stream stream{};
  if (deflateInit2(&stream, 6, Z_DEFLATED, is_gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("deflateInit2");
  }
  std::string result(bytes.size() + bytes.size() / 100 + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

/// A number of four bytes, the least first.
inline std::string four_bytes(std::size_t number) {
  std::string bytes;
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(number >> (8 * k) & 0xffU);
  return bytes;
}

/// A plain TIFF of 16-bit labels: slices from `first` on, a page each.
inline std::string tiff(const MadeVolume& volume, int first, int pages) {
  const auto width = static_cast<std::size_t>(volume.counts[0]);
  const auto height = static_cast<std::size_t>(volume.counts[1]);
  const std::size_t page_bytes = 2 * width * height;
  const std::string voxels = volume.bytes<std::uint16_t>();
  std::string bytes = "II*" + std::string(1, '\0');
  for (int z = first; z < first + pages; ++z) {
    // Where this page's directory is: behind the number that says so, and behind its voxels.
    const std::size_t begin = bytes.size() + 4;
    const std::size_t directory = begin + page_bytes;
    bytes += four_bytes(directory);
    bytes += voxels.substr(static_cast<std::size_t>(z) * page_bytes, page_bytes);
    const std::vector<std::array<std::size_t, 2>> entries = {
        {256, width}, {257, height}, {258, 16},     {259, 1},
        {262, 1},     {273, begin},  {278, height}, {279, page_bytes}};
    bytes += four_bytes(entries.size()).substr(0, 2);
    for (const auto& [tag, value] : entries) {
      bytes += four_bytes(tag).substr(0, 2) + four_bytes(4).substr(0, 2) + four_bytes(1);
      bytes += four_bytes(value);
    }
  }
  return bytes + four_bytes(0);
}

/// An NRRD of 16-bit labels.
inline std::string nrrd(const MadeVolume& volume, const std::string& fields) {
  return "NRRD0004\ntype: ushort\ndimension: 3\nencoding: raw\nendian: little\nsizes: " +
         volume.size_text() + "\n" + fields + "\n" + volume.bytes<std::uint16_t>();
}

/// A .vti of 16-bit labels at points, in base64 and packed by zlib in blocks, as VTK writes it
/// unless told otherwise.
inline std::string packed_vti(const MadeVolume& volume, const std::string& image) {
  const std::string bytes = volume.bytes<std::uint16_t>();
  constexpr std::size_t block = 4096;
  const std::size_t last = bytes.size() % block;
  std::string sizes;
  std::string blocks;
  std::size_t count = 0;
  for (std::size_t k = 0; k < bytes.size(); k += block) {
    const std::string one = packed(bytes.substr(k, block), false);
    sizes += four_bytes(one.size());
    blocks += one;
    ++count;
  }
  const std::string header = four_bytes(count) + four_bytes(block) + four_bytes(last) + sizes;
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"0.1\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt32\" "
         "compressor=\"vtkZLibDataCompressor\">\n" +
         image +
         "<PointData Scalars=\"labels\">\n<DataArray type=\"UInt16\" Name=\"labels\" "
         "format=\"binary\">\n   " +
         base64(header) + base64(blocks) +
         "\n</DataArray>\n</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
}

}  // namespace wscvt::test
