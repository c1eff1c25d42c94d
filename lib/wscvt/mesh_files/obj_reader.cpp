// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
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

/// Returns the next statement: a line without its comment, and its continuation lines.
std::optional<std::string_view> next_statement(ByteReader& reader, std::string& joined) {
  const auto without_comment = [](std::string_view line) { return line.substr(0, line.find('#')); };
  const auto is_continued = [](std::string_view line) {
    return !line.empty() && line.back() == '\\';
  };
  std::optional<std::string_view> line = reader.line();
  if (!line) return {};
  std::string_view text = without_comment(*line);
  if (!is_continued(text)) return text;
  joined.clear();
  while (is_continued(text)) {
    text.remove_suffix(1);
    joined.append(text).append(" ");
    line = reader.line();
    text = line ? without_comment(*line) : std::string_view();
  }
  joined.append(text);
  return joined;
}

constexpr std::int32_t no_number = -1;

class ObjReader {
 public:
  ObjReader(ByteReader& reader, MeshFile& file) : reader_(reader), file_(file) {}

  IndexedMesh read() {
    std::string joined;
    while (const std::optional<std::string_view> statement = next_statement(reader_, joined)) {
      TextFields fields(*statement);
      const std::string_view keyword = fields.next();
      if (keyword == "v") {
        add_vertex(fields);
      } else if (keyword == "f") {
        add_face(fields);
      } else if (keyword == "o" || keyword == "g") {
        (keyword == "o" ? objects_ : groups_).begin(std::string(trimmed(fields.rest())));
      } else {
        add_to_texture(keyword, fields);
      }
    }
    if (mesh_.points.empty()) reader_.fail("holds no vertex (a line that begins with \"v\")");
    if (largest_index_ >= static_cast<std::int64_t>(mesh_.points.size())) {
      reader_.fail("line " + std::to_string(largest_index_line_) + " names vertex " +
                   std::to_string(largest_index_ + 1) + ", but the file holds " +
                   std::to_string(mesh_.points.size()));
    }
    if (has_faces_ && mesh_.triangles.empty()) {
      reader_.fail("has faces, but none of them has three corners");
    }
    finish_attributes();
    for (FaceNames* names : {&objects_, &groups_}) names->append_to(file_.named_faces);
    return std::move(mesh_);
  }

 private:
  void add_vertex(TextFields fields) {
    reader_.check_count(mesh_.points.size() + 1, "has more vertices");
    Vector3 point;
    for (double& coordinate : point) {
      const std::string_view field = fields.next();
      const std::optional<double> value = number_in(field);
      if (field.empty()) reader_.fail_line("gives a vertex fewer than three coordinates");
      if (!value) reader_.fail_field(field, "a coordinate");
      coordinate = *value;
    }
    // A weight or a colour may follow.
    mesh_.points.push_back(point);
    add_colour(fields);
  }

  void add_colour(TextFields fields) {
    Vector3 colour = Vector3::Zero();
    for (double& part : colour) {
      const std::optional<double> value = number_in(fields.next());
      if (!value || !(*value >= 0.0 && *value <= 1.0)) return;
      part = *value;
    }
    colours_.push_back(colour);
  }

  void add_to_texture(std::string_view keyword, TextFields fields) {
    if (keyword == "vt") {
      MeshTexture::Place place = MeshTexture::no_place();
      for (float& coordinate : place) {
        const std::optional<double> value = number_in(fields.next());
        if (value) coordinate = static_cast<float>(*value);
      }
      places_.push_back(place);
    } else if (keyword == "usemtl") {
      const auto [known, is_new] =
          materials_.emplace(trimmed(fields.rest()), static_cast<std::int32_t>(materials_.size()));
      material_ = known->second;
      if (is_new) file_.attributes.texture.names.push_back(known->first);
    } else if (keyword == "mtllib") {
      file_.material_libraries.emplace_back(trimmed(fields.rest()));
    }
  }

  /// Returns the number of a corner's texture coordinates, such as 7 of "5/7/2"; no_number if there
  /// is none.
  std::int32_t place_number(std::string_view corner) const {
    const std::size_t slash = corner.find('/');
    if (slash == std::string_view::npos) return no_number;
    const std::string_view rest = corner.substr(slash + 1);
    const std::optional<std::int64_t> number = whole_number_in(rest.substr(0, rest.find('/')));
    if (!number) return no_number;
    const std::int64_t index =
        *number > 0 ? *number - 1 : static_cast<std::int64_t>(places_.size()) + *number;
    const bool fits = index >= 0 && index < std::numeric_limits<std::int32_t>::max();
    return fits ? static_cast<std::int32_t>(index) : no_number;
  }

  void finish_attributes() {
    constexpr std::array<const char*, 3> parts{"red", "green", "blue"};
    const bool has_colours = colours_.size() == mesh_.points.size();  // all vertices or none
    for (std::size_t k = 0; has_colours && k < parts.size(); ++k) {
      MeshAttribute part{parts[k], ScalarType::Uint8, {}};
      for (const Vector3& colour : colours_) {
        part.values.push_back(255.0 * colour[static_cast<Eigen::Index>(k)]);
      }
      file_.attributes.of_vertices.push_back(std::move(part));
    }
    if (places_.empty() || file_.material_libraries.empty() ||
        file_.attributes.texture.names.empty()) {
      file_.attributes.texture = MeshTexture();
      return;
    }
    MeshTexture& texture = file_.attributes.texture;
    texture.picture_of_face = std::move(material_of_face_);
    texture.corners.reserve(place_numbers_.size());
    for (const Triangle& numbers : place_numbers_) {
      std::array<MeshTexture::Place, 3> corners;
      corners.fill(MeshTexture::no_place());
      for (std::size_t k = 0; k < 3; ++k) {
        const auto number = static_cast<std::size_t>(numbers[k]);
        if (numbers[k] != no_number && number < places_.size()) corners[k] = places_[number];
      }
      texture.corners.push_back(corners);
    }
  }

  void add_face(TextFields fields) {
    has_faces_ = true;
    corners_.clear();
    corner_places_.clear();
    for (std::string_view field = fields.next(); !field.empty(); field = fields.next()) {
      // Vertex, vertex/texture, vertex//normal or vertex/texture/normal.
      const std::string_view vertex = field.substr(0, field.find('/'));
      const std::optional<std::int64_t> number = whole_number_in(vertex);
      if (!number || *number == 0) reader_.fail_field(field, "a face's vertex, numbered from 1");
      const auto known = static_cast<std::int64_t>(mesh_.points.size());
      const std::int64_t index = *number > 0 ? *number - 1 : known + *number;
      if (index < 0 || index >= std::numeric_limits<std::int32_t>::max()) {
        reader_.fail_line("names vertex " + std::to_string(*number) + ", but there are " +
                          std::to_string(known) + " up to it");
      }
      // A vertex may follow the faces that use it.
      if (index > largest_index_) {
        largest_index_ = index;
        largest_index_line_ = reader_.line_number();
      }
      corners_.push_back(static_cast<std::int32_t>(index));
      corner_places_.push_back(place_number(field));
    }
    add_polygon(corners_, mesh_.points, mesh_.triangles);
    objects_.add_to(mesh_.triangles.size());
    groups_.add_to(mesh_.triangles.size());
    for_each_triangle(corners_, mesh_.points, [&](const Triangle& t) {
      const auto place = [&](std::int32_t k) {
        return corner_places_[static_cast<std::size_t>(k)];
      };
      place_numbers_.push_back({place(t[0]), place(t[1]), place(t[2])});
    });
    material_of_face_.resize(mesh_.triangles.size(), material_);
  }

  ByteReader& reader_;
  MeshFile& file_;
  IndexedMesh mesh_;
  std::vector<std::int32_t> corners_;
  std::vector<std::int32_t> corner_places_;
  std::vector<Vector3> colours_;
  std::vector<MeshTexture::Place> places_;
  FaceNames objects_;
  FaceNames groups_;
  std::vector<Triangle> place_numbers_;  ///< of the corners of each face
  std::vector<std::int32_t> material_of_face_;
  std::map<std::string, std::int32_t, std::less<>> materials_;
  std::int32_t material_ = no_number;
  bool has_faces_ = false;
  std::int64_t largest_index_ = -1;
  std::size_t largest_index_line_ = 0;
};

}  // namespace

void read_obj(ByteReader& reader, MeshFile& file) { file.mesh = ObjReader(reader, file).read(); }

}  // namespace wscvt
