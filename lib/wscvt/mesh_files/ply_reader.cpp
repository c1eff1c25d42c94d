// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/reader_parts.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

using boost::endian::order;

enum class Encoding { Text, LittleEndian, BigEndian };

struct Property {
  std::string name;
  ScalarType type = ScalarType::Float32;  ///< of a list: type of its items
  bool is_list = false;
  ScalarType count_type = ScalarType::Uint8;  ///< of the length of a list
  bool is_kept = false;                       ///< as an attribute
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::Text;
  std::vector<Element> elements;
  std::vector<std::string> pictures;  ///< names of the wanted pictures
};

constexpr std::size_t no_list = std::numeric_limits<std::size_t>::max();

const std::array<MeshTexture::Place, 3> no_corners{MeshTexture::no_place(), MeshTexture::no_place(),
                                                   MeshTexture::no_place()};

std::optional<ScalarType> scalar_type(const std::string& name) {
  static const std::map<std::string, ScalarType> types{
      {"char", ScalarType::Int8},      {"int8", ScalarType::Int8},
      {"uchar", ScalarType::Uint8},    {"uint8", ScalarType::Uint8},
      {"short", ScalarType::Int16},    {"int16", ScalarType::Int16},
      {"ushort", ScalarType::Uint16},  {"uint16", ScalarType::Uint16},
      {"int", ScalarType::Int32},      {"int32", ScalarType::Int32},
      {"uint", ScalarType::Uint32},    {"uint32", ScalarType::Uint32},
      {"float", ScalarType::Float32},  {"float32", ScalarType::Float32},
      {"double", ScalarType::Float64}, {"float64", ScalarType::Float64}};
  const auto found = types.find(name);
  if (found == types.end()) return {};
  return found->second;
}

Stored stored(ScalarType type) {
  constexpr Stored types[] = {Stored::Int8,  Stored::Uint8,  Stored::Int16,   Stored::Uint16,
                              Stored::Int32, Stored::Uint32, Stored::Float32, Stored::Float64};
  return types[static_cast<std::size_t>(type)];
}

Header read_header(ByteReader& reader) {
  Header header;
  std::optional<std::string_view> line = reader.line();
  if (!line || TextFields(*line).next() != "ply") {
    reader.fail("does not begin with the line \"ply\" and is not a PLY file");
  }
  bool format_known = false;
  while ((line = reader.line())) {
    TextFields fields(*line);
    const std::string_view keyword = fields.next();
    if (keyword == "comment" && lower_case(fields.next()) == "texturefile") {
      header.pictures.emplace_back(trimmed(fields.rest()));
    }
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "end_header") {
      if (!format_known) reader.refuse("has a header without the line \"format\".");
      return header;
    }
    if (keyword == "format") {
      const std::string_view format = fields.next();
      static const std::map<std::string_view, Encoding> encodings{
          {"ascii", Encoding::Text},
          {"binary_little_endian", Encoding::LittleEndian},
          {"binary_big_endian", Encoding::BigEndian}};
      const auto found = encodings.find(format);
      if (found == encodings.end()) {
        reader.refuse_line("gives the format " + in_quotes(format) +
                           ". It must be ascii, binary_little_endian or binary_big_endian.");
      }
      header.encoding = found->second;
      format_known = true;
    } else if (keyword == "element") {
      Element element;
      element.name = shown(lower_case(fields.next()));
      const std::string_view field = fields.next();
      const std::optional<std::int64_t> count = whole_number_in(field);
      if (!count || *count < 0) {
        reader.refuse_line("gives " + in_quotes(field) + " for the number of elements " +
                           in_quotes(element.name) + ". It must be a whole number from 0.");
      }
      element.count = static_cast<std::uint64_t>(*count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) reader.fail_line("has a property before the first element");
      Property property;
      std::string type = lower_case(fields.next());
      if (type == "list") {
        property.is_list = true;
        const std::string count_type = lower_case(fields.next());
        const std::optional<ScalarType> known = scalar_type(count_type);
        if (!known || *known == ScalarType::Float32 || *known == ScalarType::Float64) {
          reader.refuse_line("counts a list in the type " + in_quotes(count_type) +
                             ". It must be a type of whole numbers.");
        }
        property.count_type = *known;
        type = lower_case(fields.next());
      }
      const std::optional<ScalarType> known = scalar_type(type);
      if (!known) {
        reader.fail_line("has a property of the type " + in_quotes(type) +
                         ", which PLY does not know");
      }
      property.type = *known;
      property.name = lower_case(fields.next());
      header.elements.back().properties.push_back(std::move(property));
    } else {
      reader.fail_line("of the header begins with " + in_quotes(keyword) +
                       ", which is not a keyword of PLY");
    }
  }
  reader.fail("has a header without the line \"end_header\"");
}

/// Returns the index of the first property that fits, or the number of properties.
template <class Fits>
std::size_t find_property(const Element& element, const Fits& fits) {
  const auto& all = element.properties;
  return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), fits) - all.begin());
}

/// Names that programs use for the texture coordinates of vertices.
constexpr std::array<std::array<const char*, 2>, 3> picture_places{
    {{"texture_u", "texture_v"}, {"u", "v"}, {"s", "t"}}};

/// Marks the numbers that can be transferred to a remesh. Excludes positions, normals, texture
/// coordinates and flags, because they belong only to this mesh. Marks texture coordinates if there
/// are pictures, because Body makes the texture from them.
void mark_attributes(Header& header) {
  const auto is_wanted_place = [&](const Element& element, const std::string& name) {
    return !header.pictures.empty() && element.name == "vertex" &&
           std::any_of(picture_places.begin(), picture_places.end(),
                       [&](const auto& names) { return name == names[0] || name == names[1]; });
  };
  static const std::set<std::string_view> others{
      "x", "y", "z", "nx",        "ny",        "nz",        "u",
      "v", "s", "t", "texture_u", "texture_v", "texnumber", "flags"};
  for (Element& element : header.elements) {
    if (element.name != "vertex" && element.name != "face") continue;
    std::set<std::string_view> names;
    for (Property& property : element.properties) {
      const bool is_carried =
          others.count(property.name) == 0 || is_wanted_place(element, property.name);
      property.is_kept = !property.is_list && !property.name.empty() && is_carried &&
                         names.insert(property.name).second;
    }
  }
}

/// Returns empty columns for the marked properties.
std::vector<MeshAttribute> begin_attributes(const Element& element) {
  std::vector<MeshAttribute> attributes;
  for (const Property& property : element.properties) {
    if (property.is_kept) attributes.push_back({property.name, property.type, {}});
  }
  return attributes;
}

/// Reads the data after the header: the records of the elements, in the header's order.
class Body {
 public:
  Body(ByteReader& reader, const Header& header, MeshAttributes& attributes)
      : reader_(reader), header_(header), attributes_(attributes) {}

  IndexedMesh read() {
    const Element* vertices = nullptr;
    for (const Element& element : header_.elements) {
      if (element.name != "vertex") continue;
      if (vertices != nullptr) reader_.refuse("declares the element \"vertex\" twice.");
      vertices = &element;
    }
    if (vertices == nullptr) reader_.fail("declares no element \"vertex\"");
    vertices_ = vertices->count;
    const std::string declared = "declares " + std::to_string(vertices_) + " vertices, more";
    reader_.check_count(vertices_, declared.c_str());
    bool has_faces = false;
    for (const Element& element : header_.elements) {
      check_size(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face" && element.count > 0) {
        has_faces = true;
        read_polygons(element, false);
      } else if (element.name == "tristrips" && element.count > 0) {
        has_faces = true;
        read_polygons(element, true);
      } else {
        pass_over(element);
      }
    }
    if (has_faces && mesh_.triangles.empty()) {
      reader_.fail("declares faces, but none of them has three corners");
    }
    if (!header_.pictures.empty()) finish_texture();
    return std::move(mesh_);
  }

 private:
  bool is_text() const { return header_.encoding == Encoding::Text; }

  [[noreturn]] void fail_cut(const Element& element, std::uint64_t record) const {
    reader_.fail("ends within " + element.name + " " + std::to_string(record) + ", but declares " +
                 std::to_string(element.count) + " of them. It was cut off");
  }

  static std::string named(const Element& element, std::uint64_t record) {
    return "(" + element.name + " " + std::to_string(record) + ") ";
  }

  [[noreturn]] void fail_record(const Element& element, std::uint64_t record,
                                const std::string& what) const {
    if (is_text()) reader_.fail_line(named(element, record) + what);
    reader_.fail(named(element, record) + what);
  }

  /// Refuses a header that declares more than the file can contain.
  void check_size(const Element& element) const {
    std::uint64_t least = is_text() ? 1 : 0;  // a record of text is a line
    for (const Property& property : element.properties) {
      least +=
          is_text() ? 1 : size_of(stored(property.is_list ? property.count_type : property.type));
    }
    if (element.properties.empty()) return;
    // The last line needs no line break.
    if (element.count > (reader_.remaining() + 1) / least) {
      reader_.fail("declares " + std::to_string(element.count) + " elements \"" + element.name +
                   "\", but only " + std::to_string(reader_.remaining()) +
                   " bytes are left for them. It was cut off");
    }
  }

  void read_vertices(const Element& element) {
    std::array<std::size_t, 3> columns{};
    for (std::size_t k = 0; k < 3; ++k) {
      const char name = static_cast<char>('x' + k);
      columns[k] = find_property(element, [&](const Property& property) {
        return !property.is_list && property.name.size() == 1 && property.name[0] == name;
      });
      if (columns[k] == element.properties.size()) {
        reader_.fail(std::string("declares vertices without the property \"") + name + "\"");
      }
    }
    mesh_.points.reserve(static_cast<std::size_t>(element.count));
    attributes_.of_vertices = begin_attributes(element);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      read_record(element, i, element.properties.size());
      mesh_.points.emplace_back(scalars_[columns[0]], scalars_[columns[1]], scalars_[columns[2]]);
      keep_attributes(element, 1, attributes_.of_vertices);
    }
  }

  /// Stores the numbers of the last record for `count` elements of the mesh.
  void keep_attributes(const Element& element, std::size_t count,
                       std::vector<MeshAttribute>& attributes) {
    auto attribute = attributes.begin();
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      if (!element.properties[k].is_kept) continue;
      std::vector<double>& values = (attribute++)->values;
      values.insert(values.end(), count, scalars_[k]);
    }
  }

  /// Removes the attribute with this name from the vertices' attributes and returns it.
  std::vector<double> taken_out(const char* name) {
    std::vector<MeshAttribute>& all = attributes_.of_vertices;
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const MeshAttribute& a) { return a.name == name; });
    if (found == all.end()) return {};
    std::vector<double> values = std::move(found->values);
    all.erase(found);
    return values;
  }

  /// Corners without texture coordinates get their vertex's. A mesh without any has no texture.
  void finish_texture() {
    MeshTexture& texture = attributes_.texture;
    texture.corners.resize(mesh_.triangles.size(), no_corners);
    texture.picture_of_face.resize(mesh_.triangles.size(), 0);
    for (const auto& names : picture_places) {
      const std::vector<double> u = taken_out(names[0]);
      const std::vector<double> v = taken_out(names[1]);
      if (u.empty() || v.empty()) continue;
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto vertex = static_cast<std::size_t>(mesh_.triangles[t][k]);
          MeshTexture::Place& place = texture.corners[t][k];
          if (place.allFinite() || vertex >= u.size()) continue;
          place = {static_cast<float>(u[vertex]), static_cast<float>(v[vertex])};
        }
      }
    }
    const bool has_places = std::any_of(
        texture.corners.begin(), texture.corners.end(),
        [](const std::array<MeshTexture::Place, 3>& face) { return face[0].allFinite(); });
    texture.names = header_.pictures;
    if (!has_places) texture = MeshTexture();
  }

  /// Adds the texture coordinates of the last polygon's triangles.
  void add_places(const Element& element) {
    MeshTexture& texture = attributes_.texture;
    const std::size_t number = find_property(
        element, [](const Property& p) { return !p.is_list && p.name == "texnumber"; });
    const double picture = number < element.properties.size() ? scalars_[number] : 0.0;
    const bool is_known = picture >= 0.0 && picture < static_cast<double>(header_.pictures.size());
    const bool has_places = places_.size() == 2 * corners_.size();
    const auto place = [&](std::int32_t corner) {
      const auto k = 2 * static_cast<std::size_t>(corner);
      return MeshTexture::Place(static_cast<float>(places_[k]), static_cast<float>(places_[k + 1]));
    };
    for_each_triangle(corners_, mesh_.points, [&](const Triangle& t) {
      texture.picture_of_face.push_back(is_known ? static_cast<std::int32_t>(picture) : -1);
      texture.corners.push_back(
          has_places ? std::array<MeshTexture::Place, 3>{place(t[0]), place(t[1]), place(t[2])}
                     : no_corners);
    });
  }

  /// Reads faces, or strips of triangles.
  void read_polygons(const Element& element, bool strips) {
    const std::size_t list = find_property(element, [](const Property& property) {
      return property.is_list &&
             (property.name == "vertex_indices" || property.name == "vertex_index");
    });
    if (list == element.properties.size()) {
      reader_.fail("declares elements \"" + element.name +
                   "\" without the list \"vertex_indices\"");
    }
    if (!strips) attributes_.of_faces = begin_attributes(element);
    places_list_ =
        header_.pictures.empty() ? no_list : find_property(element, [](const Property& property) {
          return property.is_list && property.name == "texcoord";
        });
    // The number of triangles of a strip is unknown before it is read.
    if (!strips) mesh_.triangles.reserve(static_cast<std::size_t>(element.count));
    for (std::uint64_t f = 0; f < element.count; ++f) {
      read_record(element, f, list);
      add_record(element, f, strips);
    }
  }

  /// Adds the polygon or strip of the last record.
  void add_record(const Element& element, std::uint64_t record, bool strip) {
    corners_.clear();
    const auto end_strip = [&] {
      add_strip(corners_.data(), corners_.size(), mesh_.triangles);
      corners_.clear();
    };
    for (const double item : items_) {
      if (strip && item == -1.0) {
        end_strip();
        continue;
      }
      const bool fits = item >= 0.0 && item < static_cast<double>(vertices_);
      if (!fits || item != static_cast<double>(static_cast<std::int32_t>(item))) {
        fail_index(element, record, item);
      }
      corners_.push_back(static_cast<std::int32_t>(item));
    }
    if (strip) {
      end_strip();
    } else {
      add_polygon(corners_, mesh_.points, mesh_.triangles);
      keep_attributes(element, std::max<std::size_t>(corners_.size(), 2) - 2, attributes_.of_faces);
      if (!header_.pictures.empty()) add_places(element);
    }
  }

  [[noreturn]] void fail_index(const Element& element, std::uint64_t record, double index) const {
    // Indices have at most 32 bits, so larger numbers in a text need not be shown.
    const std::string shown = index > -1e15 && index < 1e15
                                  ? std::to_string(static_cast<long long>(index))
                                  : "beyond all";
    fail_record(element, record,
                "names vertex " + shown + ", but the file holds " + std::to_string(vertices_) +
                    ", numbered from 0");
  }

  /// Skips the records of an element that is not needed.
  void pass_over(const Element& element) {
    if (element.properties.empty()) return;
    const bool has_list = std::any_of(element.properties.begin(), element.properties.end(),
                                      [](const Property& property) { return property.is_list; });
    if (!is_text() && !has_list) {
      std::uint64_t size = 0;
      for (const Property& property : element.properties) size += size_of(stored(property.type));
      // check_size has verified that the product is at most the file's size.
      if (!reader_.skip(size * element.count)) fail_cut(element, 0);
      return;
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!is_text()) {
        read_binary_record(element, i, element.properties.size());
      } else if (!reader_.filled_line()) {
        fail_cut(element, i);
      }
    }
  }

  /// Reads a record: scalars_[k] becomes the number of property k, items_ the wanted list.
  void read_record(const Element& element, std::uint64_t record, std::size_t wanted_list) {
    if (is_text()) {
      read_text_record(element, record, wanted_list);
    } else {
      read_binary_record(element, record, wanted_list);
    }
  }

  double number_at(ScalarType type, const char* bytes) const {
    const order of_bytes = header_.encoding == Encoding::LittleEndian ? order::little : order::big;
    return load_as<double>(stored(type), of_bytes, bytes);
  }

  void read_binary_record(const Element& element, std::uint64_t record, std::size_t wanted_list) {
    scalars_.resize(element.properties.size());
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& property = element.properties[k];
      const ScalarType type = property.is_list ? property.count_type : property.type;
      const char* const bytes = reader_.next(size_of(stored(type)));
      if (bytes == nullptr) fail_cut(element, record);
      scalars_[k] = number_at(type, bytes);
      if (!property.is_list) continue;
      const std::uint64_t count = list_count(element, record, scalars_[k]);
      const std::size_t item_size = size_of(stored(property.type));
      if (count > reader_.remaining() / item_size) fail_cut(element, record);
      if (k != wanted_list && k != places_list_) {
        if (!reader_.skip(item_size * count)) fail_cut(element, record);
        continue;
      }
      const char* const items = reader_.next(item_size * static_cast<std::size_t>(count));
      if (items == nullptr) fail_cut(element, record);
      std::vector<double>& read = k == wanted_list ? items_ : places_;
      read.resize(static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < read.size(); ++i) {
        read[i] = number_at(property.type, items + item_size * i);
      }
    }
  }

  void read_text_record(const Element& element, std::uint64_t record, std::size_t wanted_list) {
    const std::optional<std::string_view> line = reader_.filled_line();
    if (!line) fail_cut(element, record);
    TextFields fields(*line);
    const auto next_number = [&] {
      const std::string_view field = fields.next();
      const std::optional<double> value = number_in(field);
      if (value) return *value;
      if (field.empty()) {
        fail_record(element, record, "holds fewer numbers than the header declares for one");
      }
      reader_.refuse_line(named(element, record) + "has " + in_quotes(field) +
                          " instead of a number.");
    };
    scalars_.resize(element.properties.size());
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      scalars_[k] = next_number();
      if (!element.properties[k].is_list) continue;
      const std::uint64_t count = list_count(element, record, scalars_[k]);
      // An item needs a digit and a blank.
      if (count > (fields.rest().size() + 1) / 2) {
        fail_record(
            element, record,
            "has a list of " + std::to_string(count) + " items, more than there is left to read");
      }
      std::vector<double>* const read = k == wanted_list    ? &items_
                                        : k == places_list_ ? &places_
                                                            : nullptr;
      if (read != nullptr) read->resize(static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < count; ++i) {
        const double value = next_number();
        if (read != nullptr) (*read)[i] = value;
      }
    }
    if (!fields.next().empty()) {
      fail_record(element, record, "holds more numbers than the header declares for one");
    }
  }

  std::uint64_t list_count(const Element& element, std::uint64_t record, double count) const {
    if (!(count >= 0.0 && count < 4294967296.0) ||
        count != static_cast<double>(static_cast<std::uint64_t>(count))) {
      fail_record(element, record, "has a list whose count is not a whole number from 0");
    }
    return static_cast<std::uint64_t>(count);
  }

  ByteReader& reader_;
  const Header& header_;
  MeshAttributes& attributes_;
  IndexedMesh mesh_;
  std::uint64_t vertices_ = 0;
  std::vector<double> scalars_;
  std::vector<double> items_;
  std::size_t places_list_ = no_list;
  std::vector<double> places_;  ///< texture coordinates of the polygon's corners
  std::vector<std::int32_t> corners_;
};

}  // namespace

void read_ply(ByteReader& reader, MeshFile& file) {
  Header header = read_header(reader);
  mark_attributes(header);
  file.mesh = Body(reader, header, file.attributes).read();
  for (const MeshAttribute& labels : file.attributes.of_faces) {
    constexpr std::string_view colours[] = {"red", "green", "blue", "alpha"};
    if (std::find(std::begin(colours), std::end(colours), labels.name) == std::end(colours)) {
      append_labels(labels.values, file.mesh.triangles.size(), file.named_faces);
    }
  }
}

}  // namespace wscvt
