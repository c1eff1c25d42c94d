// SPDX-License-Identifier: GPL-3.0-or-later
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
#include "wscvt/mesh_files/vtk_xml.h"

namespace wscvt {

namespace {

class VtpReader {
 public:
  explicit VtpReader(ByteReader& reader)
      : reader_(reader),
        text_(reader.peek(static_cast<std::size_t>(reader.remaining()))),
        xml_(read_vtk_xml(std::make_unique<MemoryBytes>(text_))) {}

  /// Appends the labels of the faces: arrays of one whole number for each.
  IndexedMesh read(std::vector<NamedFaces>& names) {
    if (!xml_.is_whole) reader_.fail("is not the XML of a .vtp file");
    const std::string kind = value_of(xml_.file, "type");
    if (kind != "PolyData" && !is_grid_) {
      reader_.refuse("holds " + in_quotes(kind) +
                     ", not the polygons of a mesh. Save a surface as PolyData.");
    }
    if (xml_.pieces.empty()) reader_.fail("holds no piece of a mesh");
    IndexedMesh mesh;
    for (const XmlPiece& piece : xml_.pieces) add(piece, mesh);
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
  std::size_t count_in(const XmlPiece& piece, const std::string& key) const {
    const std::string text = value_of(piece.attributes, key, "0");
    const std::optional<std::int64_t> count = whole_number_in(text);
    if (!count || *count < 0) reader_.fail("has " + in_quotes(text) + " as its " + key);
    return static_cast<std::size_t>(*count);
  }

  void add(const XmlPiece& piece, IndexedMesh& mesh) {
    const std::size_t before = mesh.triangles.size();
    std::vector<std::size_t> cells(before, 0);
    add_faces(piece, mesh, cells);
    cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(before));
    for (const XmlArray& array : piece.arrays) {
      const std::string components = value_of(array.attributes, "NumberOfComponents", "1");
      if (array.section != "CellData" || (components != "1" && components != "2")) continue;
      const std::size_t width = components == "1" ? 1 : 2;  // labels of faces, or of both sides
      std::vector<double>& labels = labels_[array.name];
      if (labels.size() != width * before) continue;
      try {
        add_values_of_cells(numbers<double>(array), width, cells, labels);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::InputOutput) throw;  // else not an array of numbers
      }
    }
  }

  void add_faces(const XmlPiece& piece, IndexedMesh& mesh, std::vector<std::size_t>& cells) const {
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
  std::vector<Number> numbers(const XmlPiece& piece, const std::string& name) const {
    const auto found = std::find_if(
        piece.arrays.begin(), piece.arrays.end(),
        [&](const XmlArray& array) { return array.section + "/" + array.name == name; });
    if (found == piece.arrays.end()) reader_.fail("has no array " + in_quotes(name));
    return numbers<Number>(*found);
  }

  template <class Number>
  std::vector<Number> numbers(const XmlArray& array) const {
    const std::string format = value_of(array.attributes, "format", "ascii");
    if (array.data == 0 || array.data > text_.size()) {
      reader_.fail("has no appended data at an array's offset");
    }
    const std::string_view text = text_.substr(static_cast<std::size_t>(array.data));
    if (format == "ascii") return text_numbers<Number>(text.substr(0, text.find('<')));
    return typed_numbers<Number>(value_of(array.attributes, "type"),
                                 bytes_of(text, array.is_base64));
  }

  template <class Number>
  std::vector<Number> text_numbers(std::string_view text) const {
    TextFields fields(text);
    std::vector<Number> result;
    for (std::string_view field = fields.next(); !field.empty(); field = fields.next()) {
      const std::optional<Number> value = number_of_type<Number>(field);
      if (!value) reader_.fail("has " + in_quotes(field) + " instead of a number");
      result.push_back(*value);
    }
    return result;
  }

  /// Returns the bytes after the lengths that VTK puts before an array.
  std::string bytes_of(std::string_view text, bool is_base64) const {
    VtkPacking packing(xml_.file, [this](const std::string& what) { reader_.refuse(what); });
    packing.cut = packing.damaged =
        "holds arrays that are cut or damaged. Export it again from the program it came from.";
    std::uint64_t size = 0;
    const auto bytes =
        vtk_array_bytes(std::make_unique<MemoryBytes>(text), text.size(), is_base64, packing, size);
    std::string all;
    // As it is read, not as the file says.
    while (all.size() < size) {
      constexpr std::uint64_t at_once = std::uint64_t{1} << 20;
      const auto before = all.size();
      const auto part = static_cast<std::size_t>(std::min(at_once, size - before));
      all.resize(before + part);
      if (bytes->read(all.data() + before, part) < part) reader_.refuse(packing.cut);
    }
    return all;
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
    const boost::endian::order order = order_of(xml_.file);
    std::vector<Number> result;
    result.reserve(bytes.size() / size);
    for (std::size_t k = 0; k + size <= bytes.size(); k += size) {
      result.push_back(load_as<Number>(found->second, order, bytes.data() + k));
    }
    return result;
  }

  ByteReader& reader_;
  std::string_view text_;  ///< all of the file
  VtkXml xml_;
  bool is_grid_ = value_of(xml_.file, "type") == "UnstructuredGrid";
  std::map<std::string, std::vector<double>> labels_;  ///< of the triangles so far, by array
};

}  // namespace

void read_vtp(ByteReader& reader, MeshFile& file) {
  file.mesh = VtpReader(reader).read(file.named_faces);
}

}  // namespace wscvt
