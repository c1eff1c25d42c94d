// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's XML ImageData. Not read by VTK itself: its development package brings 239 packages and 275
// MB to a bare Debian 12, its library 100 MB to users of the program. ITK, 47 packages and 40 MB,
// reads no .vti, and reads NRRD and TIFF only whole.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <new>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#ifdef WSCVT_HAS_EXPAT
#include <expat.h>
#include <lz4.h>
#include <zlib.h>

#include "toolbox/volume/header_file.h"
#include "wscvt/base/error.h"
#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/text_fields.h"
#endif

namespace wscvt {

#ifdef WSCVT_HAS_EXPAT

namespace {

using Attributes = std::map<std::string, std::string>;

/// An array of the image.
struct VtiArray {
  Attributes attributes;
  bool of_cells = false;
  std::uint64_t data = 0;  ///< the byte after the tag
};

/// Description of the voxels in the XML.
struct VtiHeader {
  Attributes file;   ///< of VTKFile
  Attributes image;  ///< of ImageData
  Attributes piece;  ///< of the first Piece
  std::vector<VtiArray> arrays;
  Attributes appended;         ///< of AppendedData
  std::uint64_t appendix = 0;  ///< the byte after the tag
};

// Line of a parser, and the byte after its current position. Expat 2.9 has new names for them, and
// warns of the old ones.
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
std::uint64_t line_of(XML_Parser parser) { return XML_GetCurrentLineNumber64(parser); }
std::uint64_t end_of(XML_Parser parser) {
  return static_cast<std::uint64_t>(XML_GetCurrentByteIndex64(parser)) +
         XML_GetCurrentByteCount64(parser);
}
#else
std::uint64_t line_of(XML_Parser parser) { return XML_GetCurrentLineNumber(parser); }
std::uint64_t end_of(XML_Parser parser) {
  return static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser)) +
         static_cast<std::uint64_t>(XML_GetCurrentByteCount(parser));
}
#endif

/// Finds the arrays.
class VtiParser {
 public:
  explicit VtiParser(const std::string& path) : path_(path), parser_(XML_ParserCreate(nullptr)) {
    if (parser_ == nullptr) throw std::bad_alloc();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, begin_element, end_element);
  }
  VtiParser(const VtiParser&) = delete;
  VtiParser& operator=(const VtiParser&) = delete;
  ~VtiParser() { XML_ParserFree(parser_); }

  VtiHeader read() {
    const std::unique_ptr<ByteSource> bytes = file_bytes(path_, 0);
    std::array<char, 1 << 16> part{};
    while (!is_done_) {
      const std::size_t count = bytes->read(part.data(), part.size());
      const bool is_last = count < part.size();
      const XML_Status status =
          XML_Parse(parser_, part.data(), static_cast<int>(count), is_last ? 1 : 0);
      if (is_done_ || is_last) break;
      if (status != XML_STATUS_OK) fail();
    }
    // Errors after the arrays are found when they are read; a file that was cut has arrays too.
    if (header_.arrays.empty()) {
      if (XML_GetErrorCode(parser_) != XML_ERROR_NONE && !is_done_) fail();
      refuse_volume(path_, "holds no array of labels. Export it again.");
    }
    return header_;
  }

 private:
  [[noreturn]] void fail() {
    refuse_volume(path_, std::string("is not the XML of a .vti file: ") +
                             XML_ErrorString(XML_GetErrorCode(parser_)) + " in line " +
                             std::to_string(line_of(parser_)) + ". Export it again.");
  }

  static void begin_element(void* self, const char* name, const char** attributes) {
    static_cast<VtiParser*>(self)->begin(name, attributes);
  }
  static void end_element(void* self, const char* name) {
    auto& parser = *static_cast<VtiParser*>(self);
    if (parser.section_ == name) parser.section_.clear();
  }

  void begin(const std::string& name, const char** pairs) {
    Attributes attributes;
    for (; *pairs != nullptr; pairs += 2) attributes[pairs[0]] = pairs[1];
    if (name == "VTKFile") {
      header_.file = attributes;
    } else if (name == "ImageData") {
      header_.image = attributes;
    } else if (name == "Piece" && header_.piece.empty()) {
      header_.piece = attributes;
    } else if (name == "PointData" || name == "CellData") {
      section_ = name;
    } else if (name == "DataArray" && !section_.empty()) {
      header_.arrays.push_back({attributes, section_ == "CellData", end_of(parser_)});
    } else if (name == "AppendedData") {
      header_.appended = attributes;
      header_.appendix = end_of(parser_);
      is_done_ = true;  // the rest may not be XML
      XML_StopParser(parser_, XML_FALSE);
    }
  }

  std::string path_;
  XML_Parser parser_;
  VtiHeader header_;
  std::string section_;
  bool is_done_ = false;
};

/// Compression of the blocks of an array.
enum class Packer { None, ZLib, Lz4 };

/// Bytes after the lengths that VTK writes before an array.
class VtkArrayBytes : public MadeBytes {
 public:
  VtkArrayBytes(std::unique_ptr<ByteSource> bytes, std::uint64_t wanted, const VoxelType& length,
                Packer packer, std::string path)
      : bytes_(std::move(bytes)),
        wanted_(wanted),
        length_(length),
        packer_(packer),
        path_(std::move(path)) {
    read_lengths();
  }

  std::size_t read(char* bytes, std::size_t count) override {
    return packer_ == Packer::None ? bytes_->read(bytes, count) : MadeBytes::read(bytes, count);
  }

 private:
  std::uint64_t next_length() {
    std::array<char, 8> bytes{};
    const auto size = static_cast<std::size_t>(length_.bytes);
    if (bytes_->read(bytes.data(), size) < size) refuse();
    return load_as<std::uint64_t>(
        size == 4 ? Stored::Uint32 : Stored::Uint64,
        length_.big_endian ? boost::endian::order::big : boost::endian::order::little,
        bytes.data());
  }

  void read_lengths() {
    if (packer_ == Packer::None) {
      if (next_length() != wanted_) refuse();
      return;
    }
    const std::uint64_t blocks = next_length();
    block_ = next_length();
    last_ = next_length();
    if (blocks == 0 || block_ == 0 || blocks > wanted_ / block_ + 1 ||
        (last_ == 0 ? blocks * block_ : (blocks - 1) * block_ + last_) != wanted_) {
      refuse();
    }
    for (std::uint64_t k = 0; k < blocks; ++k) packed_sizes_.push_back(next_length());
  }

  /// Unpacks a block.
  bool make(std::vector<char>& made) override {
    if (next_block_ == packed_sizes_.size()) return false;
    const bool is_last = next_block_ + 1 == packed_sizes_.size();
    const std::uint64_t size = is_last && last_ != 0 ? last_ : block_;
    const std::uint64_t packed_size = packed_sizes_[next_block_++];
    // Allocates no more than any compression can reach.
    constexpr std::uint64_t most_packed = 1100;
    constexpr std::uint64_t most_block = std::uint64_t{1} << 30;
    if (packed_size > most_block || size > most_block || size > packed_size * most_packed) refuse();
    packed_.resize(packed_size);
    if (bytes_->read(packed_.data(), packed_.size()) < packed_.size()) refuse();
    made.resize(size);
    bool is_whole = false;
    if (packer_ == Packer::ZLib) {
      uLongf count = size;
      is_whole = ::uncompress(reinterpret_cast<Bytef*>(made.data()), &count,
                              reinterpret_cast<const Bytef*>(packed_.data()),
                              static_cast<uLong>(packed_.size())) == Z_OK &&
                 count == size;
    } else {
      is_whole =
          ::LZ4_decompress_safe(packed_.data(), made.data(), static_cast<int>(packed_.size()),
                                static_cast<int>(made.size())) == static_cast<int>(size);
    }
    if (!is_whole) {
      refuse_volume(path_,
                    "holds packed voxels that are damaged. Copy the file again, or export "
                    "it again.");
    }
    return true;
  }

  [[noreturn]] void refuse() const {
    refuse_volume(path_, "has another number of bytes than its size needs, " +
                             std::to_string(wanted_) + ". Copy it again, or export it again.");
  }

  std::unique_ptr<ByteSource> bytes_;
  std::uint64_t wanted_;
  VoxelType length_;
  Packer packer_;
  std::string path_;
  std::uint64_t block_ = 0;  ///< bytes of every block but the last
  std::uint64_t last_ = 0;   ///< bytes of the last block; 0: as the others
  std::vector<std::uint64_t> packed_sizes_;
  std::size_t next_block_ = 0;
  std::vector<char> packed_;
};

std::string value_of(const Attributes& attributes, const std::string& key,
                     const std::string& fallback) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? fallback : found->second;
}

template <std::size_t Count>
std::array<double, Count> numbers_of(const Attributes& attributes, const std::string& key,
                                     const std::string& fallback, const std::string& path) {
  std::array<double, Count> numbers{};
  const std::string text = value_of(attributes, key, fallback);
  TextFields fields(text);
  for (double& number : numbers) {
    const std::optional<double> value = number_in(fields.next());
    if (!value)
      refuse_volume(path, "has " + in_quotes(text) + " as its " + key + ". Export it again.");
    number = *value;
  }
  return numbers;
}

/// Returns the first and last points along each axis: x0 x1 y0 y1 z0 z1.
std::array<std::int64_t, 6> extent_of(const VtiHeader& header, const std::string& path) {
  std::array<std::int64_t, 6> extent{};
  const std::string whole = value_of(header.image, "WholeExtent", "");
  const std::string text = value_of(header.piece, "Extent", whole);
  if (text != whole) {
    refuse_volume(path, "is in pieces, or has a part of the image. Save it in one piece.");
  }
  TextFields fields(text);
  for (std::int64_t& place : extent) {
    const std::optional<std::int64_t> number = whole_number_in(fields.next());
    constexpr std::int64_t farthest = 1000000000;
    if (!number || *number > farthest || *number < -farthest) {
      refuse_volume(path, "has " + in_quotes(text) + " as its extent. Export it again.");
    }
    place = *number;
  }
  return extent;
}

VolumeGeometry geometry_of(const VtiHeader& header, bool of_cells, const VolumeChoice& choice,
                           const std::string& path) {
  const std::array<std::int64_t, 6> extent = extent_of(header, path);
  const int more = of_cells ? 0 : 1;
  VolumeGeometry geometry;
  geometry.has_size = header.image.count("Spacing") > 0;
  geometry.counts = voxel_counts(
      {extent[1] - extent[0] + more, extent[3] - extent[2] + more, extent[5] - extent[4] + more},
      path);
  const auto origin = numbers_of<3>(header.image, "Origin", "0 0 0", path);
  const auto spacing = numbers_of<3>(header.image, "Spacing", "1 1 1", path);
  const auto direction = numbers_of<9>(header.image, "Direction", "1 0 0 0 1 0 0 0 1", path);
  Eigen::Matrix3d axes;
  for (Eigen::Index k = 0; k < 9; ++k) {
    axes(k / 3, k % 3) =
        direction[static_cast<std::size_t>(k)] * spacing[static_cast<std::size_t>(k % 3)];
  }
  const Vector3 first(static_cast<double>(extent[0]), static_cast<double>(extent[2]),
                      static_cast<double>(extent[4]));
  require_spacing({spacing[0], spacing[1], spacing[2]}, choice, path);
  const double to_centre = of_cells ? 0.5 : 0.0;
  set_lattice(
      geometry, axes,
      Vector3(origin[0], origin[1], origin[2]) + axes * (first + Vector3::Constant(to_centre)),
      choice, path);
  return geometry;
}

/// Returns the first byte of the appended data: after white space and a "_".
std::uint64_t begin_of_appended(const std::string& path, std::uint64_t data) {
  const std::unique_ptr<ByteSource> bytes = file_bytes(path, data);
  constexpr std::uint64_t most_white_space = 1000;
  for (std::uint64_t k = 0; k < most_white_space; ++k) {
    char c = 0;
    if (bytes->read(&c, 1) == 0) break;
    if (c == '_') return data + k + 1;
    if (c != ' ' && !(c >= '\t' && c <= '\r')) break;
  }
  refuse_volume(path, "has no \"_\" before its appended data. Export it again.");
}

Packer packer_of(const std::string& name, const std::string& path) {
  if (name.empty()) return Packer::None;
  if (name == "vtkZLibDataCompressor") return Packer::ZLib;
  if (name == "vtkLZ4DataCompressor") return Packer::Lz4;
  refuse_volume(path, "is packed by " + in_quotes(name) + ". Save it plain, or by ZLib or LZ4.");
}

}  // namespace

std::unique_ptr<LabelVolume> open_vti(const std::string& path, const VolumeChoice& choice) {
  const std::uint64_t size = file_size(path);
  const VtiHeader header = VtiParser(path).read();
  std::vector<std::string> names;
  for (const VtiArray& array : header.arrays) {
    names.push_back(value_of(array.attributes, "Name", ""));
  }
  const VtiArray& array = header.arrays[chosen_array(names, choice, path)];
  VoxelType type = voxel_type_of(value_of(array.attributes, "type", ""), path);
  type.big_endian = value_of(header.file, "byte_order", "LittleEndian") == "BigEndian";
  const std::optional<std::int64_t> components =
      whole_number_in(value_of(array.attributes, "NumberOfComponents", "1"));
  const VolumeGeometry geometry = geometry_of(header, array.of_cells, choice, path);
  const std::vector<BlockPick> picks =
      picks_of({{AxisKind::Channel, components.value_or(0)}}, choice, path);

  const std::string format = value_of(array.attributes, "format", "ascii");
  std::uint64_t begin = array.data;
  const bool is_appended = format == "appended";
  if (is_appended) {
    const std::optional<std::int64_t> offset =
        whole_number_in(value_of(array.attributes, "offset", "0"));
    if (!offset || *offset < 0) refuse_volume(path, "has no offset of its array. Export it again.");
    if (header.appendix == 0) refuse_volume(path, "has no appended data. Export it again.");
    begin = begin_of_appended(path, header.appendix) + static_cast<std::uint64_t>(*offset);
  }
  const std::uint64_t left = size - std::min(size, begin);
  std::uint64_t wanted = stored_bytes(geometry.counts, type, picks);
  OpenBytes open;
  if (format == "ascii") {
    wanted = wanted / static_cast<std::uint64_t>(type.bytes) * sizeof(double);
    check_voxel_bytes(wanted, left, Packing::Text, path);
    type = {sizeof(double), true, true, false};
    open = [=] { return bytes_of_numbers(file_bytes(path, begin), path); };
  } else if (is_appended || format == "binary") {
    const std::string packer_name = value_of(header.file, "compressor", "");
    const bool is_text = !is_appended || value_of(header.appended, "encoding", "base64") != "raw";
    const Packer packer = packer_of(packer_name, path);
    check_voxel_bytes(wanted, is_text ? left / 4 * 3 : left,
                      packer == Packer::None ? Packing::None : Packing::Deflate, path);
    VoxelType length{4, false, false, type.big_endian};
    if (value_of(header.file, "header_type", "UInt32") == "UInt64") length.bytes = 8;
    open = [=] {
      std::unique_ptr<ByteSource> bytes = file_bytes(path, begin);
      if (is_text) bytes = base64_bytes(std::move(bytes));
      return std::make_unique<VtkArrayBytes>(std::move(bytes), wanted, length, packer, path);
    };
  } else {
    refuse_volume(
        path, "has its voxels as " + in_quotes(format) + ". Save it ascii, binary or appended.");
  }
  return volume_of_bytes(geometry, type, picks, std::move(open), path);
}

#else

std::unique_ptr<LabelVolume> open_vti(const std::string& path, const VolumeChoice&) {
  refuse_without(path, "Expat", "libexpat1-dev");
}

#endif

}  // namespace wscvt
