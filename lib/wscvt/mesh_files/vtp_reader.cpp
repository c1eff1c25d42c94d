// SPDX-License-Identifier: GPL-3.0-or-later
// VTK itself is not used, because its library is 100 MB. Its XML has only a few tags with
// attributes. An XML parser would be one more library to link.
#include <zlib.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/reader_parts.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

using Attributes = std::map<std::string, std::string>;

std::string value_of(const Attributes& attributes, const std::string& key,
                     const std::string& fallback = "") {
  const auto found = attributes.find(key);
  return found == attributes.end() ? fallback : found->second;
}

struct Tag {
  std::string name;  ///< with its slash if it ends an element
  Attributes attributes;
  std::size_t end = 0;  ///< the byte after it
};

struct Array {
  Attributes attributes;
  std::size_t data = 0;  ///< the byte after its tag
};

struct Piece {
  Attributes attributes;
  std::map<std::string, Array> arrays;  ///< "Points/", "Polys/offsets"
};

/// Whether an element contains arrays. Other elements may be inside an array.
bool is_section(const std::string& name) {
  constexpr std::string_view sections[] = {"Points",    "Verts",    "Lines",     "Strips", "Polys",
                                           "PointData", "CellData", "FieldData", "Cells"};
  return std::find(std::begin(sections), std::end(sections), name) != std::end(sections);
}

/// The bytes of an array, from base64 or unchanged.
class ArrayBytes {
 public:
  ArrayBytes(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

  /// Returns the maximum number of bytes that the remaining text can encode.
  std::size_t most() const {
    const std::size_t left = text_.size() - at_;
    return is_base64_ ? left / 4 * 3 + 3 + held_.size() : left;
  }

  /// Returns nothing if fewer bytes are left.
  std::optional<std::string> next(std::size_t count) {
    if (count > most()) return {};
    std::string bytes;
    if (!is_base64_) {
      bytes = text_.substr(at_, count);
      at_ += count;
      return bytes;
    }
    while (held_.size() < count && decode_four()) {
    }
    if (held_.size() < count) return {};
    bytes = held_.substr(0, count);
    held_.erase(0, count);
    return bytes;
  }

 private:
  /// Several base64 texts may follow each other, each padded with "=".
  bool decode_four() {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::uint32_t value = 0;
    std::size_t known = 0;
    for (std::size_t k = 0; k < 4;) {
      if (at_ == text_.size()) return false;
      const char c = text_[at_++];
      if (is_blank(c)) continue;
      const std::size_t digit = digits.find(c);
      if (digit == std::string_view::npos && (c != '=' || k < 2)) return false;
      if (digit != std::string_view::npos) known = k + 1;
      value = value << 6 | (digit == std::string_view::npos ? 0U : static_cast<unsigned>(digit));
      ++k;
    }
    for (std::size_t k = 0; k + 1 < known; ++k) {
      held_.push_back(static_cast<char>(value >> (16 - 8 * k) & 0xFFU));
    }
    return true;
  }

  std::string_view text_;
  bool is_base64_;
  std::size_t at_ = 0;
  std::string held_;
};

class VtpReader {
 public:
  explicit VtpReader(ByteReader& reader)
      : reader_(reader), text_(reader.peek(static_cast<std::size_t>(reader.remaining()))) {}

  /// Appends the labels of the faces: arrays of one whole number for each.
  IndexedMesh read(std::vector<NamedFaces>& names) {
    read_tags();
    if (pieces_.empty()) reader_.fail("holds no piece of a mesh");
    IndexedMesh mesh;
    for (const Piece& piece : pieces_) add(piece, mesh);
    if (mesh.points.empty()) reader_.fail("holds no points");
    if (is_grid_ && mesh.triangles.empty()) {
      reader_.refuse("holds no triangles or polygons. Save the surface of the grain too.");
    }
    for (const auto& [name, labels] : labels_) {
      append_labels(labels, mesh.triangles.size(), names);
    }
    return mesh;
  }

 private:
  [[noreturn]] void fail_xml() const { reader_.fail("is not the XML of a .vtp file"); }

  /// Returns the next tag from a byte on; nothing at the end of the text.
  std::optional<Tag> tag_from(std::size_t at) const {
    for (;;) {
      at = text_.find('<', at);
      if (at == std::string_view::npos) return {};
      const bool is_comment = text_.substr(at, 4) == "<!--";
      if (!is_comment && text_.substr(at, 2) != "<?") break;
      at = text_.find(is_comment ? "-->" : "?>", at);
      if (at == std::string_view::npos) return {};
    }
    ++at;
    const auto word_end = [&](std::size_t from) {
      while (from < text_.size() && !is_blank(text_[from]) && text_[from] != '>' &&
             text_[from] != '=' && (text_[from] != '/' || from == at)) {
        ++from;
      }
      return from;
    };
    Tag tag;
    std::size_t end = word_end(at);
    tag.name = text_.substr(at, end - at);
    for (at = end;;) {
      while (at < text_.size() && (is_blank(text_[at]) || text_[at] == '/')) ++at;
      if (at >= text_.size()) fail_xml();
      if (text_[at] == '>') break;
      end = word_end(at);
      const std::string key(text_.substr(at, end - at));
      at = end;
      while (at < text_.size() && (is_blank(text_[at]) || text_[at] == '=')) ++at;
      if (at >= text_.size() || (text_[at] != '"' && text_[at] != '\'')) fail_xml();
      end = text_.find(text_[at], at + 1);
      if (end == std::string_view::npos) fail_xml();
      tag.attributes[key] = text_.substr(at + 1, end - at - 1);
      at = end + 1;
    }
    tag.end = at + 1;
    return tag;
  }

  void read_tags() {
    std::string section;
    std::size_t at = 0;
    bool is_vtk = false;
    while (const std::optional<Tag> tag = tag_from(at)) {
      at = tag->end;
      if (tag->name == "VTKFile") {
        is_vtk = true;
        file_ = tag->attributes;
        const std::string kind = value_of(file_, "type");
        is_grid_ = kind == "UnstructuredGrid";
        if (kind != "PolyData" && !is_grid_) {
          reader_.refuse("holds " + in_quotes(kind) +
                         ", not the polygons of a mesh. Save a surface as PolyData.");
        }
      } else if (!is_vtk) {
        fail_xml();
      } else if (tag->name == "Piece") {
        pieces_.push_back({tag->attributes, {}});
      } else if (tag->name == "DataArray" && !pieces_.empty()) {
        const std::string name = section == "Points" ? "" : value_of(tag->attributes, "Name");
        pieces_.back().arrays[section + "/" + name] = {tag->attributes, at};
      } else if (tag->name == "AppendedData") {
        is_base64_ = value_of(tag->attributes, "encoding", "base64") != "raw";
        while (at < text_.size() && is_blank(text_[at])) ++at;
        if (at < text_.size() && text_[at] == '_') appendix_ = at + 1;
        return;  // the rest need not be XML
      } else if (is_section(tag->name)) {
        section = tag->name;
      }
    }
    if (!is_vtk) fail_xml();
  }

  std::size_t count_in(const Piece& piece, const std::string& key) const {
    const std::string text = value_of(piece.attributes, key, "0");
    const std::optional<std::int64_t> count = whole_number_in(text);
    if (!count || *count < 0) reader_.fail("has " + in_quotes(text) + " as its " + key);
    return static_cast<std::size_t>(*count);
  }

  void add(const Piece& piece, IndexedMesh& mesh) {
    const std::size_t before = mesh.triangles.size();
    std::vector<std::size_t> cells(before, 0);
    add_faces(piece, mesh, cells);
    cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(before));
    constexpr std::string_view section = "CellData/";
    for (const auto& [name, array] : piece.arrays) {
      const std::string components = value_of(array.attributes, "NumberOfComponents", "1");
      if (name.rfind(section, 0) != 0 || (components != "1" && components != "2")) continue;
      const std::size_t width = components == "1" ? 1 : 2;  // labels of faces, or of both sides
      std::vector<double>& labels = labels_[name];
      if (labels.size() != width * before) continue;
      try {
        add_values_of_cells(numbers<double>(piece, name), width, cells, labels);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::InputOutput) throw;  // else not an array of numbers
      }
    }
  }

  void add_faces(const Piece& piece, IndexedMesh& mesh, std::vector<std::size_t>& cells) const {
    const std::size_t count = count_in(piece, "NumberOfPoints");
    const std::size_t first = mesh.points.size();
    if (count > 0) {
      const std::vector<double> coordinates = numbers<double>(piece, "Points/");
      if (coordinates.size() / 3 != count || coordinates.size() % 3 != 0) {
        reader_.fail("has " + std::to_string(coordinates.size()) + " coordinates of " +
                     std::to_string(count) + " points");
      }
      for (std::size_t i = 0; i < count; ++i) {
        mesh.points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1],
                                 coordinates[3 * i + 2]);
      }
    }
    if (is_grid_ && count_in(piece, "NumberOfCells") == 0) return;
    if (is_grid_) {
      const VtkPolygons grid{numbers<std::int64_t>(piece, "Cells/connectivity"),
                             numbers<std::int64_t>(piece, "Cells/offsets")};
      return add_surface_cells(grid, numbers<std::int64_t>(piece, "Cells/types"), first, reader_,
                               mesh, cells);
    }
    std::size_t cell = count_in(piece, "NumberOfVerts") + count_in(piece, "NumberOfLines");
    // VTK numbers the polygons before the strips.
    for (const bool strips : {false, true}) {
      const std::string section = strips ? "Strips" : "Polys";
      const std::size_t faces = count_in(piece, "NumberOf" + section);
      if (faces == 0) continue;
      VtkPolygons polygons{numbers<std::int64_t>(piece, section + "/connectivity"),
                           numbers<std::int64_t>(piece, section + "/offsets")};
      if (polygons.ends.size() != faces) {
        reader_.fail("has ends of " + std::to_string(polygons.ends.size()) + " faces and " +
                     std::to_string(faces) + " faces");
      }
      add_polygons(polygons, strips, first, reader_, mesh, cell, cells);
      cell += faces;
    }
  }

  template <class Number>
  std::vector<Number> numbers(const Piece& piece, const std::string& name) const {
    const auto found = piece.arrays.find(name);
    if (found == piece.arrays.end()) reader_.fail("has no array " + in_quotes(name));
    const Array& array = found->second;
    const std::string format = value_of(array.attributes, "format", "ascii");
    if (format == "ascii") return text_numbers<Number>(array);
    const std::string type = value_of(array.attributes, "type");
    if (format == "appended") {
      const std::optional<std::int64_t> offset =
          whole_number_in(value_of(array.attributes, "offset", "0"));
      if (appendix_ == 0 || !offset || *offset < 0 ||
          static_cast<std::uint64_t>(*offset) > text_.size() - appendix_) {
        reader_.fail("has no appended data at an array's offset");
      }
      return typed_numbers<Number>(
          type,
          bytes_of({text_.substr(appendix_ + static_cast<std::size_t>(*offset)), is_base64_}));
    }
    const std::string_view rest = text_.substr(array.data);
    return typed_numbers<Number>(type, bytes_of({rest.substr(0, rest.find('<')), true}));
  }

  template <class Number>
  std::vector<Number> text_numbers(const Array& array) const {
    const std::string_view rest = text_.substr(array.data);
    TextFields fields(rest.substr(0, rest.find('<')));
    std::vector<Number> result;
    for (std::string_view field = fields.next(); !field.empty(); field = fields.next()) {
      const std::optional<Number> value = number_of_type<Number>(field);
      if (!value) reader_.fail("has " + in_quotes(field) + " instead of a number");
      result.push_back(*value);
    }
    return result;
  }

  [[noreturn]] void fail_cut() const { reader_.fail("holds arrays that are cut or damaged"); }

  std::uint64_t next_length(ArrayBytes& bytes) const {
    const bool is_long = value_of(file_, "header_type", "UInt32") == "UInt64";
    const std::optional<std::string> text = bytes.next(is_long ? 8 : 4);
    if (!text) fail_cut();
    return load_as<std::uint64_t>(is_long ? Stored::Uint64 : Stored::Uint32, order(), text->data());
  }

  /// Returns the bytes after the lengths that VTK puts before an array.
  std::string bytes_of(ArrayBytes bytes) const {
    const std::string packer = value_of(file_, "compressor");
    if (packer.empty()) {
      const std::uint64_t size = next_length(bytes);
      if (size > bytes.most()) fail_cut();
      const std::optional<std::string> all = bytes.next(static_cast<std::size_t>(size));
      if (!all) fail_cut();
      return *all;
    }
    if (packer != "vtkZLibDataCompressor") {
      reader_.refuse("is packed by " + in_quotes(packer) + ". Save it plain, or by ZLib.");
    }
    const std::uint64_t blocks = next_length(bytes);
    const std::uint64_t block = next_length(bytes);
    const std::uint64_t last = next_length(bytes);
    if (blocks > bytes.most() / 4) fail_cut();
    std::vector<std::uint64_t> packed_sizes;
    for (std::uint64_t k = 0; k < blocks; ++k) packed_sizes.push_back(next_length(bytes));
    std::string all;
    for (std::uint64_t k = 0; k < blocks; ++k) {
      const std::uint64_t size = k + 1 == blocks && last != 0 ? last : block;
      // Refuses sizes that no compression can reach, before it allocates memory.
      constexpr std::uint64_t most_packed = 1100;
      if (packed_sizes[k] > bytes.most() || size / most_packed > packed_sizes[k]) fail_cut();
      const std::optional<std::string> packed =
          bytes.next(static_cast<std::size_t>(packed_sizes[k]));
      if (!packed) fail_cut();
      const std::size_t before = all.size();
      all.resize(before + static_cast<std::size_t>(size));
      uLongf made = size;
      if (::uncompress(reinterpret_cast<Bytef*>(all.data() + before), &made,
                       reinterpret_cast<const Bytef*>(packed->data()),
                       static_cast<uLong>(packed->size())) != Z_OK ||
          made != size) {
        fail_cut();
      }
    }
    return all;
  }

  boost::endian::order order() const {
    return value_of(file_, "byte_order", "LittleEndian") == "BigEndian"
               ? boost::endian::order::big
               : boost::endian::order::little;
  }

  template <class Number>
  std::vector<Number> typed_numbers(const std::string& type, const std::string& bytes) const {
    static const std::map<std::string, Stored> types = {
        {"Int8", Stored::Int8},      {"UInt8", Stored::Uint8},   {"Int16", Stored::Int16},
        {"UInt16", Stored::Uint16},  {"Int32", Stored::Int32},   {"UInt32", Stored::Uint32},
        {"Int64", Stored::Int64},    {"UInt64", Stored::Uint64}, {"Float32", Stored::Float32},
        {"Float64", Stored::Float64}};
    const auto found = types.find(type);
    const bool is_whole = type.find("Int") != std::string::npos;
    if (found == types.end() || (!is_whole && !std::is_same_v<Number, double>)) {
      reader_.fail("has an array of " + in_quotes(type) + " instead of other numbers");
    }
    const std::size_t size = size_of(found->second);
    std::vector<Number> result;
    result.reserve(bytes.size() / size);
    for (std::size_t k = 0; k + size <= bytes.size(); k += size) {
      result.push_back(load_as<Number>(found->second, order(), bytes.data() + k));
    }
    return result;
  }

  ByteReader& reader_;
  std::string_view text_;  ///< all of the file
  bool is_grid_ = false;   ///< unstructured
  Attributes file_;        ///< of VTKFile
  std::vector<Piece> pieces_;
  std::map<std::string, std::vector<double>> labels_;  ///< of the triangles so far, by array
  std::size_t appendix_ = 0;  ///< the first byte of the appended data; 0: no data
  bool is_base64_ = true;     ///< of the appended data
};

}  // namespace

void read_vtp(ByteReader& reader, MeshFile& file) {
  file.mesh = VtpReader(reader).read(file.named_faces);
}

}  // namespace wscvt
