// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/reader_parts.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

/// Nodes with numbers of their own, and faces that name them.
class ElementMesh {
 public:
  explicit ElementMesh(ByteReader& reader) : reader_(reader) {}

  void add_node(std::int64_t number, const Vector3& point) {
    reader_.check_count(points_.size() + 1, "has more nodes");
    if (!known_.emplace(number, static_cast<std::int32_t>(points_.size())).second) {
      reader_.fail_line("gives node " + std::to_string(number) + " a second time");
    }
    points_.push_back(point);
  }

  /// `group`: the name of a set that the face is of; empty: none.
  void add_face(const std::vector<std::int64_t>& nodes, const std::string& group) {
    faces_.insert(faces_.end(), nodes.begin(), nodes.end());
    ends_.push_back(faces_.size());
    if (groups_.empty() || groups_.back().second != group) groups_.emplace_back(0, group);
    groups_.back().first = ends_.size();
  }

  /// Nodes may follow the elements that use them. Appends the names of groups.
  IndexedMesh mesh(std::vector<NamedFaces>& lists) {
    if (points_.empty()) reader_.fail("holds no nodes");
    if (ends_.empty()) {
      reader_.refuse("holds no triangles or quadrilaterals. Save the surface of the grain too.");
    }
    IndexedMesh mesh;
    mesh.points = std::move(points_);
    std::vector<std::int32_t> corners;
    FaceNames names;
    std::size_t begin = 0;
    std::size_t group = 0;
    // Faces of no group are a set without a name, wherever they stand.
    names.begin(groups_.front().second);
    for (std::size_t face = 0; face < ends_.size(); ++face) {
      const std::size_t end = ends_[face];
      if (face == groups_[group].first) {
        names.add_to(mesh.triangles.size());
        names.begin(groups_[++group].second);
      }
      corners.clear();
      for (; begin < end; ++begin) {
        const auto found = known_.find(faces_[begin]);
        if (found == known_.end()) {
          reader_.fail("names node " + std::to_string(faces_[begin]) + ", which it does not hold");
        }
        corners.push_back(found->second);
      }
      add_polygon(corners, mesh.points, mesh.triangles);
    }
    names.add_to(mesh.triangles.size());
    names.append_to(lists);
    return mesh;
  }

 private:
  ByteReader& reader_;
  std::vector<Vector3> points_;
  std::unordered_map<std::int64_t, std::int32_t> known_;
  std::vector<std::int64_t> faces_;
  std::vector<std::size_t> ends_;
  /// The number of faces up to the last one of a run of one group, and its name.
  std::vector<std::pair<std::size_t, std::string>> groups_;
};

/// Returns the corners of an element of Gmsh by its type; 0 for others than faces.
std::size_t corners_of_gmsh(std::int64_t type) {
  constexpr std::int64_t triangle = 2;
  constexpr std::int64_t quadrilateral = 3;
  constexpr std::int64_t triangle_of_6 = 9;
  constexpr std::int64_t quadrilateral_of_9 = 10;
  constexpr std::int64_t quadrilateral_of_8 = 16;
  if (type == triangle || type == triangle_of_6) return 3;
  if (type == quadrilateral || type == quadrilateral_of_8 || type == quadrilateral_of_9) return 4;
  return 0;
}

class GmshReader {
 public:
  explicit GmshReader(ByteReader& reader) : reader_(reader), mesh_(reader) {}

  IndexedMesh read(std::vector<NamedFaces>& names) {
    bool has_format = false;
    while (const std::optional<std::string_view> line = reader_.filled_line()) {
      const std::string_view section = trimmed(*line);
      if (section == "$MeshFormat") {
        read_format();
        has_format = true;
      } else if (!has_format) {
        reader_.fail("does not begin with \"$MeshFormat\" and is not a mesh of Gmsh");
      } else if (section == "$PhysicalNames") {
        read_group_names();
      } else if (section == "$Entities") {
        read_entities();
      } else if (section == "$Nodes") {
        is_old_ ? read_old_nodes() : read_nodes();
      } else if (section == "$Elements") {
        is_old_ ? read_old_elements() : read_elements();
      }
    }
    return mesh_.mesh(names);
  }

 private:
  static constexpr std::int64_t surface_ = 2;  // a dimension

  TextFields next_fields() {
    const std::optional<std::string_view> line = reader_.filled_line();
    if (!line) reader_.fail("ends within a section. It was cut off");
    return TextFields(*line);
  }

  template <class Number>
  Number number(TextFields& fields) {
    const std::string_view field = fields.next();
    const std::optional<Number> value = number_of_type<Number>(field);
    if (!value) reader_.fail_field(field, "a number");
    return *value;
  }

  std::int64_t whole(TextFields& fields) { return number<std::int64_t>(fields); }

  /// Returns the first number of the next line.
  std::int64_t next_whole() {
    TextFields fields = next_fields();
    return whole(fields);
  }

  Vector3 point(TextFields& fields) {
    Vector3 place;
    for (double& coordinate : place) coordinate = number<double>(fields);
    return place;
  }

  void read_format() {
    TextFields fields = next_fields();
    const std::string version(fields.next());
    is_old_ = version == "2" || version.rfind("2.", 0) == 0;
    if (!is_old_ && version != "4.1") {
      reader_.refuse_line("gives the version " + in_quotes(version) +
                          ". Save the mesh as version 4.1 or 2 of Gmsh.");
    }
    if (whole(fields) != 0) reader_.refuse("is a binary mesh of Gmsh. Save it as text.");
  }

  void read_group_names() {
    const std::int64_t count = next_whole();
    for (std::int64_t k = 0; k < count; ++k) {
      TextFields fields = next_fields();
      const std::int64_t dimension = whole(fields);
      const std::int64_t group = whole(fields);
      std::string name(trimmed(fields.rest()));
      if (name.size() > 1 && name.front() == '"') name = name.substr(1, name.rfind('"') - 1);
      if (dimension == surface_) group_names_[group] = name;
    }
  }

  /// Reads the groups of surfaces. Lines of points and curves come before them.
  void read_entities() {
    TextFields counts = next_fields();
    std::array<std::int64_t, 4> sizes{};
    for (std::int64_t& size : sizes) size = whole(counts);
    for (const std::int64_t size : {sizes[0], sizes[1]}) {
      for (std::int64_t k = 0; k < size; ++k) next_fields();
    }
    for (std::int64_t k = 0; k < sizes[2]; ++k) {
      TextFields fields = next_fields();
      const std::int64_t surface = whole(fields);
      point(fields);  // the ends of its box
      point(fields);
      // A minus turns the surface in its group.
      if (whole(fields) > 0) group_of_surface_[surface] = std::abs(whole(fields));
    }
  }

  /// Returns the name of a physical group; empty: 0, which is none.
  std::string name_of(std::int64_t group) const {
    if (group == 0) return "";
    const auto found = group_names_.find(group);
    return found == group_names_.end() ? std::to_string(group) : found->second;
  }

  void read_old_nodes() {
    const std::int64_t count = next_whole();
    for (std::int64_t k = 0; k < count; ++k) {
      TextFields fields = next_fields();
      const std::int64_t tag = whole(fields);
      mesh_.add_node(tag, point(fields));
    }
  }

  void read_nodes() {
    const std::int64_t blocks = next_whole();
    for (std::int64_t block = 0; block < blocks; ++block) {
      TextFields heading = next_fields();
      whole(heading);  // dimension
      whole(heading);  // entity
      whole(heading);  // whether parameters follow the coordinates
      const std::int64_t count = whole(heading);
      std::vector<std::int64_t> tags;
      for (std::int64_t k = 0; k < count; ++k) tags.push_back(next_whole());
      for (const std::int64_t tag : tags) {
        TextFields fields = next_fields();
        mesh_.add_node(tag, point(fields));
      }
    }
  }

  void add_element(std::int64_t type, std::int64_t group, TextFields& fields) {
    const std::size_t corners = corners_of_gmsh(type);
    if (corners == 0) return;
    nodes_.clear();
    for (std::size_t k = 0; k < corners; ++k) nodes_.push_back(whole(fields));
    mesh_.add_face(nodes_, name_of(group));
  }

  void read_old_elements() {
    const std::int64_t count = next_whole();
    for (std::int64_t k = 0; k < count; ++k) {
      TextFields fields = next_fields();
      whole(fields);  // its number
      const std::int64_t type = whole(fields);
      const std::int64_t tags = whole(fields);
      const std::int64_t group = tags > 0 ? whole(fields) : 0;
      for (std::int64_t tag = 1; tag < tags; ++tag) whole(fields);
      add_element(type, group, fields);
    }
  }

  void read_elements() {
    const std::int64_t blocks = next_whole();
    for (std::int64_t block = 0; block < blocks; ++block) {
      TextFields heading = next_fields();
      const bool is_surface = whole(heading) == surface_;
      const auto found = group_of_surface_.find(whole(heading));
      const std::int64_t group = is_surface && found != group_of_surface_.end() ? found->second : 0;
      const std::int64_t type = whole(heading);
      const std::int64_t count = whole(heading);
      for (std::int64_t k = 0; k < count; ++k) {
        TextFields fields = next_fields();
        whole(fields);  // its number
        add_element(type, group, fields);
      }
    }
  }

  ByteReader& reader_;
  ElementMesh mesh_;
  bool is_old_ = false;
  std::vector<std::int64_t> nodes_;
  std::map<std::int64_t, std::string> group_names_;
  std::map<std::int64_t, std::int64_t> group_of_surface_;  ///< the first one
};

/// Splits a line of Abaqus at its commas.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (bool is_last = false; !is_last;) {
    const std::size_t end = line.find(',');
    is_last = end == std::string_view::npos;
    fields.push_back(trimmed(line.substr(0, end)));
    line.remove_prefix(is_last ? line.size() : end + 1);
  }
  if (fields.back().empty()) fields.pop_back();  // a line may end with a comma
  return fields;
}

/// An option of a keyword's line: "ELSET=Grain".
struct AbaqusOption {
  std::string key;  ///< in lower case
  std::string_view value;
};

std::vector<AbaqusOption> options_of(const std::vector<std::string_view>& fields) {
  std::vector<AbaqusOption> options;
  for (const std::string_view field : fields) {
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) continue;
    options.push_back(
        {lower_case(trimmed(field.substr(0, equals))), trimmed(field.substr(equals + 1))});
  }
  return options;
}

/// Returns the corners of a shell, membrane, rigid or plane element by its type, such as "S3R",
/// "STRI65", "M3D4" or "CPS6M", or one with an axis, as meshio names quadrilaterals ("CAX4P"); 0
/// for others.
std::size_t corners_of_abaqus(const std::string& type) {
  for (const char* family : {"stri", "sfm3d", "m3d", "r3d", "ds", "cps", "cpe", "cax", "s"}) {
    if (type.rfind(family, 0) != 0) continue;
    const std::string rest = type.substr(std::string_view(family).size());
    if (rest.empty() || rest[0] < '3' || rest[0] > '9') continue;
    return rest[0] == '3' || rest[0] == '6' ? 3 : 4;
  }
  return 0;
}

[[noreturn]] void refuse_instances(const ByteReader& reader) {
  reader.refuse_line(
      "moves or repeats a part by *INSTANCE, which is not read. Write the file without parts and "
      "assemblies (Abaqus: Model > Edit Attributes).");
}

/// Refuses a keyword that puts nodes elsewhere, makes them, or has them in another file, and warns
/// of one that looks so. `fields` are those of its line.
void judge_abaqus_keyword(const std::vector<std::string_view>& fields, ByteReader& reader) {
  const std::string keyword = lower_case(fields[0]);
  const bool has_data = keyword == "*node" || keyword == "*element";
  for (const auto& [key, value] : options_of(fields)) {
    if (key == "input" && (has_data || keyword == "*include")) {
      reader.refuse_line("has its lines in the file " + in_quotes(value) +
                         ", which is not read. Put them in the place of this line.");
    }
    if (keyword == "*node" && key == "system" && lower_case(value) != "r") {
      reader.refuse_line("gives nodes in " +
                         std::string(lower_case(value) == "c" ? "cylindrical" : "spherical") +
                         " coordinates, which are not read. Write x, y and z.");
    }
  }
  if (keyword == "*system") {
    reader.refuse_line(
        "moves nodes by *SYSTEM, which is not read. Write their coordinates without it.");
  }
  for (const char* const maker : {"*ngen", "*nfill", "*ncopy", "*nmap", "*elgen", "*elcopy"}) {
    if (keyword != maker) continue;
    reader.refuse_line("makes nodes or elements by " + in_quotes(keyword) +
                       ", which is not read. Write them all, as Abaqus/CAE does.");
  }
  if (keyword == "*transform") {
    reader.warn(
        "has *TRANSFORM, which turns displacements and loads and no node. It was left out.");
  }
}

}  // namespace

void read_gmsh(ByteReader& reader, MeshFile& file) {
  file.mesh = GmshReader(reader).read(file.named_faces);
}

void read_abaqus(ByteReader& reader, MeshFile& file) {
  ElementMesh mesh(reader);
  enum class Block { Other, Nodes, Faces, Instance } block = Block::Other;
  bool has_instance = false;
  std::size_t corners = 0;
  std::string group;
  std::vector<std::int64_t> nodes;
  const auto whole = [&](std::string_view field) {
    const std::optional<std::int64_t> value = whole_number_in(field);
    if (!value) reader.fail_field(field, "a number");
    return *value;
  };
  while (const std::optional<std::string_view> line = reader.filled_line()) {
    const std::string_view text = trimmed(*line);
    if (text.substr(0, 2) == "**") continue;
    const std::vector<std::string_view> fields = fields_of(text);
    if (fields.empty()) continue;
    if (text.front() == '*') {
      judge_abaqus_keyword(fields, reader);
      const std::string keyword = lower_case(fields[0]);
      block = keyword == "*node"       ? Block::Nodes
              : keyword == "*instance" ? Block::Instance
                                       : Block::Other;
      if (block == Block::Instance && std::exchange(has_instance, true)) refuse_instances(reader);
      if (keyword != "*element") continue;
      group.clear();
      for (const auto& [key, value] : options_of(fields)) {
        if (key == "elset") group = value;
        if (key != "type") continue;
        corners = corners_of_abaqus(lower_case(value));
        if (corners > 0) block = Block::Faces;
      }
    } else if (block == Block::Nodes) {
      Vector3 point = Vector3::Zero();
      for (std::size_t k = 1; k < fields.size() && k <= 3; ++k) {
        const std::optional<double> value = number_in(fields[k]);
        if (!value) reader.fail_field(fields[k], "a coordinate");
        point[static_cast<Eigen::Index>(k - 1)] = *value;
      }
      mesh.add_node(whole(fields[0]), point);
    } else if (block == Block::Instance) {
      // A translation, and in the next line a rotation.
      for (const std::string_view field : fields) {
        if (number_in(field) != 0.0) refuse_instances(reader);
      }
    } else if (block == Block::Faces) {
      if (fields.size() < corners + 1) reader.fail_line("has fewer nodes than its type of element");
      nodes.clear();
      for (std::size_t k = 1; k <= corners; ++k) nodes.push_back(whole(fields[k]));
      mesh.add_face(nodes, group);
    }
  }
  file.mesh = mesh.mesh(file.named_faces);
}

}  // namespace wscvt
