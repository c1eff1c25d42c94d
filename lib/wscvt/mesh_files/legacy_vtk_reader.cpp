// SPDX-License-Identifier: GPL-3.0-or-later
// https://docs.vtk.org/en/latest/vtk_file_formats/. VTK itself is not used, because its library is
// 100 MB.
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/reader_parts.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

struct NamedType {
  std::string_view name;
  Stored type;
};

/// VTK's names of number types. In a binary file the most significant byte is first.
constexpr NamedType vtk_types[] = {{"char", Stored::Int8},
                                   {"signed_char", Stored::Int8},
                                   {"unsigned_char", Stored::Uint8},
                                   {"short", Stored::Int16},
                                   {"unsigned_short", Stored::Uint16},
                                   {"int", Stored::Int32},
                                   {"unsigned_int", Stored::Uint32},
                                   {"long", Stored::Int64},
                                   {"unsigned_long", Stored::Uint64},
                                   {"vtktypeint64", Stored::Int64},
                                   {"vtktypeuint64", Stored::Uint64},
                                   {"vtkidtype", Stored::Int32},
                                   {"float", Stored::Float32},
                                   {"double", Stored::Float64}};

class LegacyVtkReader {
 public:
  explicit LegacyVtkReader(ByteReader& reader) : reader_(reader) {}

  /// Appends the labels of the faces: arrays of one whole number for each.
  IndexedMesh read(std::vector<NamedFaces>& names) {
    if (lower_case(reader_.line().value_or("")).rfind("# vtk datafile version", 0) != 0) {
      reader_.fail("does not begin with \"# vtk DataFile Version\" and is not a VTK file");
    }
    reader_.line();  // a title
    const std::string form = lower_case(TextFields(reader_.line().value_or("")).next());
    if (form != "ascii" && form != "binary") reader_.fail_line("is neither ASCII nor BINARY");
    is_text_ = form == "ascii";
    bool goes_on = true;
    while (goes_on) {
      const std::optional<std::string_view> line = reader_.filled_line();
      goes_on = line && read_section(std::string(*line));
    }
    if (mesh_.points.empty()) reader_.fail("holds no points");
    std::vector<std::size_t> cells;
    if (is_grid_) {
      add_surface_cells(polygons_, cell_types_, 0, reader_, mesh_, cells);
    } else {
      const std::size_t others = other_cells_;  // VTK numbers vertices and lines first, strips last
      add_polygons(polygons_, false, 0, reader_, mesh_, others, cells);
      add_polygons(strips_, true, 0, reader_, mesh_, others + polygons_.ends.size(), cells);
    }
    if (is_grid_ && mesh_.triangles.empty()) {
      reader_.refuse("holds no triangles or polygons. Save the surface of the grain too.");
    }
    read_labels(cells, names);
    return std::move(mesh_);
  }

 private:
  /// Returns false if the data of points and faces begins; it follows the mesh.
  bool read_section(const std::string& line) {
    TextFields fields(line);
    const std::string key = lower_case(fields.next());
    if (begins_data(key, fields)) return false;
    if (key == "metadata") {
      skip_metadata();
    } else if (key == "dataset") {
      const std::string kind = lower_case(fields.next());
      is_grid_ = kind == "unstructured_grid";
      if (kind != "polydata" && !is_grid_) {
        reader_.refuse("holds " + in_quotes(kind) +
                       ", not the polygons of a mesh. Save a surface as POLYDATA.");
      }
    } else if (key == "field") {
      fields.next();
      const std::size_t arrays = count_in(fields);
      for (std::size_t k = 0; k < arrays; ++k) next_array();
    } else if (key == "points") {
      read_points(fields);
    } else if (key == "polygons" || key == "cells") {
      polygons_ = polygons_of(fields);
    } else if (key == "triangle_strips") {
      strips_ = polygons_of(fields);
    } else if (key == "vertices" || key == "lines") {
      other_cells_ += polygons_of(fields).ends.size();
    } else if (key == "cell_types") {
      cell_types_ = numbers<std::int64_t>(Stored::Int32, count_in(fields));
    } else {
      reader_.fail_field(key, "a part of a mesh");
    }
    return true;
  }

  /// Whether a line begins the data of points or faces; reads it then.
  bool begins_data(const std::string& key, TextFields& fields) {
    if (key != "point_data" && key != "cell_data") return false;
    is_of_cells_ = key == "cell_data";
    data_count_ = count_in(fields);
    return true;
  }

  /// Metadata end with a blank line.
  void skip_metadata() {
    while (!TextFields(reader_.line().value_or("")).next().empty()) {
    }
  }

  /// Reads the data of points and faces up to what is neither SCALARS nor FIELD. The mesh does not
  /// need them, so a fault ends the reading.
  void read_labels(const std::vector<std::size_t>& cells, std::vector<NamedFaces>& names) {
    const auto take = [&](const std::vector<double>& values) {
      const std::size_t width = values.size() == 2 * data_count_ ? 2 : 1;  // of faces, or of sides
      if (!is_of_cells_ || values.size() != width * data_count_) return;
      std::vector<double> labels;
      add_values_of_cells(values, width, cells, labels);
      append_labels(labels, mesh_.triangles.size(), names);
    };
    try {
      while (const std::optional<std::string_view> line = reader_.filled_line()) {
        const std::string text(*line);
        TextFields fields(text);
        const std::string key = lower_case(fields.next());
        if (begins_data(key, fields)) continue;
        if (key == "metadata") {
          skip_metadata();
        } else if (key == "scalars") {
          fields.next();
          const Stored type = type_in(fields);
          const std::string_view components = fields.next();
          if (!components.empty() && components != "1" && components != "2") return;
          reader_.filled_line();  // its table of colours
          take(numbers<double>(type, components == "2" ? 2 * data_count_ : data_count_));
        } else if (key == "color_scalars") {
          // VTK writes every array of 8 bits so, in text by the 255th part.
          fields.next();
          const std::size_t width = count_in(fields);
          if (width > 4) return;
          auto values = numbers<double>(Stored::Uint8, width * data_count_);
          for (double& value : values) value = is_text_ ? std::round(255.0 * value) : value;
          take(values);
        } else if (key == "field") {
          fields.next();
          const std::size_t arrays = count_in(fields);
          for (std::size_t k = 0; k < arrays; ++k) take(next_array());
        } else {
          return;
        }
      }
    } catch (const Error& error) {
      if (error.code() != ErrorCode::InputOutput) throw;
    }
  }

  void read_points(TextFields& fields) {
    const std::size_t count = count_in(fields);
    const Stored type = type_in(fields);
    reader_.check_count(count, "declares more points");
    const auto coordinates = numbers<double>(type, 3 * count);
    mesh_.points.clear();
    mesh_.points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      mesh_.points.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
    }
  }

  /// Before version 5: the number of lists, the total of numbers, then each list with its length
  /// first. From version 5: the number of ends (the first is 0), the number of corners, then both
  /// arrays.
  VtkPolygons polygons_of(TextFields& fields) {
    const std::size_t count = count_in(fields);
    const std::size_t size = count_in(fields);
    VtkPolygons result;
    if (lower_case(reader_.peek(7)) == "offsets") {
      result.ends = named_numbers(count);
      if (!result.ends.empty()) result.ends.erase(result.ends.begin());
      result.corners = named_numbers(size);
      return result;
    }
    const auto all = numbers<std::int64_t>(Stored::Int32, size);
    for (std::size_t at = 0, k = 0; k < count; ++k) {
      const std::int64_t length = at < all.size() ? all[at] : -1;
      if (length < 0 || static_cast<std::uint64_t>(length) > all.size() - at - 1) {
        reader_.fail("has a face of " + std::to_string(length) +
                     " corners, which the file does not hold");
      }
      const auto from = all.begin() + static_cast<std::ptrdiff_t>(at) + 1;
      result.corners.insert(result.corners.end(), from, from + length);
      result.ends.push_back(static_cast<std::int64_t>(result.corners.size()));
      at += static_cast<std::size_t>(length) + 1;
    }
    return result;
  }

  /// Reads "OFFSETS vtktypeint64" and the numbers.
  std::vector<std::int64_t> named_numbers(std::size_t count) {
    TextFields fields(reader_.filled_line().value_or(""));
    fields.next();
    const Stored type = type_in(fields);
    if (type == Stored::Float32 || type == Stored::Float64) {
      reader_.fail_line("announces corners that are not whole numbers");
    }
    return numbers<std::int64_t>(type, count);
  }

  std::vector<double> next_array() {
    TextFields fields(reader_.filled_line().value_or(""));
    fields.next();
    const std::size_t components = count_in(fields);
    const std::size_t tuples = count_in(fields);
    if (lower_case(TextFields(fields.rest()).next()) == "string") {
      reader_.refuse_line("is an array of texts, which is not supported. Save only the mesh.");
    }
    const Stored type = type_in(fields);
    if (tuples > 0 && components > std::numeric_limits<std::size_t>::max() / tuples) fail_cut();
    return numbers<double>(type, components * tuples);
  }

  std::size_t count_in(TextFields& fields) {
    const std::string_view field = fields.next();
    const std::optional<std::int64_t> value = whole_number_in(field);
    if (!value || *value < 0) reader_.fail_field(field, "a number of things");
    return static_cast<std::size_t>(*value);
  }

  Stored type_in(TextFields& fields) {
    const std::string name = lower_case(fields.next());
    const auto* const found =
        std::find_if(std::begin(vtk_types), std::end(vtk_types),
                     [&](const NamedType& type) { return type.name == name; });
    if (found == std::end(vtk_types)) reader_.fail_field(name, "a type of numbers");
    return found->type;
  }

  template <class Number>
  std::vector<Number> numbers(Stored type, std::size_t count) {
    const std::size_t size = size_of(type);
    // A number in text needs a digit and a blank.
    const std::size_t least = is_text_ ? 2 : size;
    if (count > (reader_.remaining() + 1) / least) fail_cut();
    std::vector<Number> result;
    result.reserve(count);
    if (is_text_) {
      while (result.size() < count) add_line(result, count);
      return result;
    }
    for (std::size_t k = 0; k < count; ++k) {
      const char* const bytes = reader_.next(size);
      if (bytes == nullptr) fail_cut();
      result.push_back(load_as<Number>(type, boost::endian::order::big, bytes));
    }
    return result;
  }

  /// Ignores the rest of a line that has more numbers.
  template <class Number>
  void add_line(std::vector<Number>& result, std::size_t count) {
    const std::optional<std::string_view> line = reader_.line();
    if (!line) fail_cut();
    TextFields fields(*line);
    for (std::string_view field = fields.next(); !field.empty(); field = fields.next()) {
      const std::optional<Number> value = number_of_type<Number>(field);
      if (!value || result.size() == count) {
        reader_.fail_line("has " + in_quotes(field) +
                          (value ? " behind the last of " + std::to_string(count) + " numbers"
                                 : " instead of a number"));
      }
      result.push_back(*value);
    }
  }

  [[noreturn]] void fail_cut() const {
    reader_.fail("has fewer numbers than it announces. It was cut off");
  }

  ByteReader& reader_;
  bool is_text_ = false;
  bool is_grid_ = false;
  IndexedMesh mesh_;
  VtkPolygons polygons_;
  VtkPolygons strips_;
  std::vector<std::int64_t> cell_types_;
  std::size_t other_cells_ = 0;  ///< vertices and lines
  bool is_of_cells_ = false;     ///< the data that are read, else of points
  std::size_t data_count_ = 0;
};

}  // namespace

void read_legacy_vtk(ByteReader& reader, MeshFile& file) {
  file.mesh = LegacyVtkReader(reader).read(file.named_faces);
}

}  // namespace wscvt
