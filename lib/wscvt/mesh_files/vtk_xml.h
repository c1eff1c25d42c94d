// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/endian/conversion.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "wscvt/mesh_files/byte_source.h"

namespace wscvt {

// VTK's files in XML: meshes in memory, and volumes larger than it.
// https://docs.vtk.org/en/latest/vtk_file_formats/

using XmlAttributes = std::map<std::string, std::string>;

std::string value_of(const XmlAttributes& attributes, const std::string& key,
                     const std::string& fallback = "");

/// An array of a piece.
struct XmlArray {
  std::string section;  ///< "Points", "CellData"
  std::string name;     ///< empty for Points
  XmlAttributes attributes;
  std::uint64_t data = 0;  ///< its first byte, also if appended; 0: no data
  bool is_base64 = true;   ///< if it is no text
};

struct XmlPiece {
  XmlAttributes attributes;
  std::vector<XmlArray> arrays;
};

struct VtkXml {
  XmlAttributes file;   ///< of VTKFile
  XmlAttributes image;  ///< of ImageData
  std::vector<XmlPiece> pieces;
  bool is_whole = false;  ///< false: the rest is cut, or not such XML
};

/// Reads the tags up to the appended data, which need not be XML. Does not throw for other text,
/// see is_whole, but what `source` throws.
VtkXml read_vtk_xml(std::unique_ptr<ByteSource> source);

/// Returns the order of the bytes of numbers, from the attributes of VTKFile.
boost::endian::order order_of(const XmlAttributes& file);

/// Unpacks a block into `made`, which has its size. Returns whether it has exactly this size.
using UnpackBlock = bool (*)(const std::vector<char>& packed, std::vector<char>& made);

/// How a file has the bytes of its arrays, and how a reader refuses them.
struct VtkPacking {
  /// From the attributes of VTKFile. `throw_error` gets what is wrong. `unpack_lz4`: null if LZ4 is
  /// not read. Calls throw_error for an unknown packer.
  VtkPacking(const XmlAttributes& file, std::function<void(const std::string&)> throw_error,
             UnpackBlock unpack_lz4 = nullptr);

  boost::endian::order order;
  bool has_long_lengths;
  UnpackBlock unpack = nullptr;  ///< null: not packed
  std::function<void(const std::string&)> refuse;
  std::string cut;      ///< what is wrong with lengths that do not fit, or too few bytes
  std::string damaged;  ///< what is wrong with blocks that cannot be unpacked
};

/// Returns the bytes of an array that begins where `stored` does, and their number, as the lengths
/// before it say. `left`: the number of bytes in `stored`. Sizes that no packing can reach are
/// refused before memory is allocated for them. If it is not packed, more bytes may follow. Throws
/// what packing.refuse does, now or as it is read.
std::unique_ptr<ByteSource> vtk_array_bytes(std::unique_ptr<ByteSource> stored, std::uint64_t left,
                                            bool is_base64, const VtkPacking& packing,
                                            std::uint64_t& size);

}  // namespace wscvt
