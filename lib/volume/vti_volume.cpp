// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's XML ImageData. Not by VTK itself: its development package brings 239 packages and 275 MB
// to a bare Debian 12, its library 100 MB to whoever only runs the program. ITK, 47 packages and 40
// MB, reads no .vti, and NRRD and TIFF only whole.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <new>
#include <utility>

#include "volume/volume_formats.h"
#include "volume/voxel_rows.h"
#ifdef WSCVT_HAS_EXPAT
#include <expat.h>

#include "volume/header_file.h"
#include "wscvt/base/error.h"
#include "wscvt/scan/text_fields.h"
#endif

namespace wscvt {

#ifdef WSCVT_HAS_EXPAT

namespace {

using Attributes = std::map<std::string, std::string>;

/// What the XML in front of the voxels says.
struct VtiHeader {
  Attributes file;      ///< of VTKFile
  Attributes image;     ///< of ImageData
  Attributes piece;     ///< of the first Piece
  Attributes array;     ///< of the array that is taken
  Attributes appended;  ///< of AppendedData
  bool of_cells = false;
  std::uint64_t data = 0;  ///< the byte after the tag behind which the voxels stand
};

// Where a parser is: its line, and the byte behind what it is at. Expat 2.9 has other names for
// them, and warns of the old ones.
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

/// Finds the array of labels: the scalars, or the first.
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
      if (is_done_) break;
      if (status != XML_STATUS_OK) {
        refuse_volume(path_, std::string("is not the XML of a .vti file: ") +
                                 XML_ErrorString(XML_GetErrorCode(parser_)) + " in line " +
                                 std::to_string(line_of(parser_)) + "; export it again.");
      }
      if (is_last) refuse_volume(path_, "holds no array of labels; export it again.");
    }
    return header_;
  }

 private:
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
      scalars_ = attributes["Scalars"];
    } else if (name == "DataArray" && !section_.empty() && header_.array.empty()) {
      if (!scalars_.empty() && attributes["Name"] != scalars_) return;
      header_.array = attributes;
      header_.of_cells = section_ == "CellData";
      if (attributes["format"] != "appended") end_here();
    } else if (name == "AppendedData") {
      header_.appended = attributes;
      end_here();
    }
  }

  void end_here() {
    header_.data = end_of(parser_);
    is_done_ = true;
    XML_StopParser(parser_, XML_FALSE);
  }

  std::string path_;
  XML_Parser parser_;
  VtiHeader header_;
  std::string section_;
  std::string scalars_;
  bool is_done_ = false;
};

/// What stands behind the lengths that VTK puts before an array.
class VtkArrayBytes : public ByteSource {
 public:
  VtkArrayBytes(std::unique_ptr<ByteSource> bytes, std::uint64_t wanted, const VoxelType& length,
                bool is_packed, std::string path)
      : bytes_(std::move(bytes)),
        wanted_(wanted),
        length_(length),
        is_packed_(is_packed),
        path_(std::move(path)) {
    skip_lengths();
  }

  std::size_t read(char* bytes, std::size_t count) override { return bytes_->read(bytes, count); }

  void rewind() override {
    bytes_->rewind();
    skip_lengths();
  }

 private:
  std::uint64_t next_length() {
    std::array<char, 8> bytes{};
    const auto size = static_cast<std::size_t>(length_.bytes);
    std::uint64_t value = 0;
    if (bytes_->read(bytes.data(), size) < size) refuse();
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t place = length_.big_endian ? k : size - 1 - k;
      value = value << 8 | static_cast<unsigned char>(bytes[place]);
    }
    return value;
  }

  void skip_lengths() {
    if (!is_packed_) {
      if (next_length() != wanted_) refuse();
      return;
    }
    const std::uint64_t blocks = next_length();
    const std::uint64_t block = next_length();
    const std::uint64_t last = next_length();
    if (blocks == 0 || block == 0 || blocks > wanted_ / block + 1 ||
        (last == 0 ? blocks * block : (blocks - 1) * block + last) != wanted_) {
      refuse();
    }
    // The blocks are zlib streams that stand one behind the other, so their sizes are not needed.
    for (std::uint64_t k = 0; k < blocks; ++k) next_length();
  }

  [[noreturn]] void refuse() const {
    refuse_volume(path_, "holds another number of bytes than its size asks for, " +
                             std::to_string(wanted_) + "; copy it again, or export it again.");
  }

  std::unique_ptr<ByteSource> bytes_;
  std::uint64_t wanted_;
  VoxelType length_;
  bool is_packed_;
  std::string path_;
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
      refuse_volume(path, "has " + in_quotes(text) + " as its " + key + "; export it again.");
    number = *value;
  }
  return numbers;
}

/// Where the first and last points are along each axis: x0 x1 y0 y1 z0 z1.
std::array<std::int64_t, 6> extent_of(const VtiHeader& header, const std::string& path) {
  std::array<std::int64_t, 6> extent{};
  const std::string whole = value_of(header.image, "WholeExtent", "");
  const std::string text = value_of(header.piece, "Extent", whole);
  if (text != whole) {
    refuse_volume(path, "is in pieces, or holds a part of the image; save it in one.");
  }
  TextFields fields(text);
  for (std::int64_t& place : extent) {
    const std::optional<std::int64_t> number = whole_number_in(fields.next());
    constexpr std::int64_t farthest = 1000000000;
    if (!number || *number > farthest || *number < -farthest) {
      refuse_volume(path, "has " + in_quotes(text) + " as its extent; export it again.");
    }
    place = *number;
  }
  return extent;
}

VolumeGeometry geometry_of(const VtiHeader& header, const std::optional<Vector3>& voxel_size,
                           const std::string& path) {
  const std::array<std::int64_t, 6> extent = extent_of(header, path);
  const int more = header.of_cells ? 0 : 1;
  VolumeGeometry geometry;
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
  const double to_centre = header.of_cells ? 0.5 : 0.0;
  set_lattice(
      geometry, axes,
      Vector3(origin[0], origin[1], origin[2]) + axes * (first + Vector3::Constant(to_centre)),
      voxel_size, path);
  return geometry;
}

/// The byte at which the appended data begin: after white space and a "_".
std::uint64_t begin_of_appended(const std::string& path, std::uint64_t data) {
  const std::unique_ptr<ByteSource> bytes = file_bytes(path, data);
  constexpr std::uint64_t most_white_space = 1000;
  for (std::uint64_t k = 0; k < most_white_space; ++k) {
    char c = 0;
    if (bytes->read(&c, 1) == 0) break;
    if (c == '_') return data + k + 1;
    if (c != ' ' && !(c >= '\t' && c <= '\r')) break;
  }
  refuse_volume(path, "has no \"_\" before its appended data; export it again.");
}

}  // namespace

std::unique_ptr<LabelVolume> open_vti(const std::string& path,
                                      const std::optional<Vector3>& voxel_size) {
  const std::uint64_t size = file_size(path);
  const VtiHeader header = VtiParser(path).read();
  if (header.array.empty()) refuse_volume(path, "holds no array of labels; export it again.");
  if (value_of(header.array, "NumberOfComponents", "1") != "1") {
    refuse_volume(path, "has voxels of more than one number; save the labels alone.");
  }
  const VolumeGeometry geometry = geometry_of(header, voxel_size, path);
  VoxelType type = voxel_type_of(value_of(header.array, "type", ""), path);
  type.big_endian = value_of(header.file, "byte_order", "LittleEndian") == "BigEndian";

  const std::string format = value_of(header.array, "format", "ascii");
  const std::string packer = value_of(header.file, "compressor", "");
  const bool is_packed = !packer.empty();
  const bool is_known = format == "appended" || format == "binary";
  if (!is_known || (is_packed && packer != "vtkZLibDataCompressor")) {
    refuse_volume(path, "has its voxels as " + in_quotes(is_known ? packer : format) +
                            "; save it binary or appended, plain or by ZLib.");
  }
  std::uint64_t begin = header.data;
  bool is_text = true;
  if (format == "appended") {
    const std::optional<std::int64_t> offset =
        whole_number_in(value_of(header.array, "offset", "0"));
    if (!offset || *offset < 0) refuse_volume(path, "has no offset of its array; export it again.");
    begin = begin_of_appended(path, header.data) + static_cast<std::uint64_t>(*offset);
    is_text = value_of(header.appended, "encoding", "base64") != "raw";
  }
  const std::uint64_t left = size - std::min(size, begin);
  check_voxel_bytes(geometry, type, is_text ? left / 4 * 3 : left, is_packed, path);

  VoxelType length{4, false, type.big_endian};
  if (value_of(header.file, "header_type", "UInt32") == "UInt64") length.bytes = 8;
  std::unique_ptr<ByteSource> bytes = file_bytes(path, begin);
  if (is_text) bytes = base64_bytes(std::move(bytes));
  bytes = std::make_unique<VtkArrayBytes>(std::move(bytes), voxel_bytes(geometry.counts, type),
                                          length, is_packed, path);
  if (is_packed) bytes = inflated_bytes(std::move(bytes), path);
  return volume_of_bytes(geometry, type, std::move(bytes), path);
}

#else

std::unique_ptr<LabelVolume> open_vti(const std::string& path, const std::optional<Vector3>&) {
  refuse_volume(path,
                "cannot be read: this program was built without Expat; install libexpat1-dev "
                "and build it again, or save the volume as .nrrd.");
}

#endif

}  // namespace wscvt
