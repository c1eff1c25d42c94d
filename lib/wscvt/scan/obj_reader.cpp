// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/obj_reader.h"

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/scan/polygon_fan.h"
#include "wscvt/scan/text_fields.h"

namespace wscvt {

namespace {

/// The next statement: a line without its comment, with those it is continued on.
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

class ObjReader {
 public:
  explicit ObjReader(ByteReader& reader) : reader_(reader) {}

  IndexedMesh read() {
    std::string joined;
    while (const std::optional<std::string_view> statement = next_statement(reader_, joined)) {
      TextFields fields(*statement);
      const std::string_view keyword = fields.next();
      if (keyword == "v") {
        add_vertex(fields);
      } else if (keyword == "f") {
        add_face(fields);
      }
    }
    if (mesh_.points.empty()) {
      reader_.fail("holds no vertex (a line that begins with \"v\")" + std::string(export_again));
    }
    if (largest_index_ >= static_cast<std::int64_t>(mesh_.points.size())) {
      reader_.fail("line " + std::to_string(largest_index_line_) + " names vertex " +
                   std::to_string(largest_index_ + 1) + ", but the file holds " +
                   std::to_string(mesh_.points.size()) + export_again);
    }
    if (has_faces_ && mesh_.triangles.empty()) {
      reader_.fail("has faces, but none of them has three corners" + std::string(export_again));
    }
    return std::move(mesh_);
  }

 private:
  void add_vertex(TextFields fields) {
    if (mesh_.points.size() == static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      reader_.fail("has more vertices than can be numbered; reduce the scan first.");
    }
    Vector3 point;
    for (double& coordinate : point) {
      const std::string_view field = fields.next();
      const std::optional<double> value = number_in(field);
      if (!value) {
        reader_.fail_line(
            field.empty()
                ? "gives a vertex fewer than three coordinates" + std::string(export_again)
                : "has " + in_quotes(field) + " where a coordinate is due" + export_again);
      }
      coordinate = *value;
    }
    // A weight or a colour may follow.
    mesh_.points.push_back(point);
  }

  void add_face(TextFields fields) {
    has_faces_ = true;
    corners_.clear();
    for (std::string_view field = fields.next(); !field.empty(); field = fields.next()) {
      // Vertex, vertex/texture, vertex//normal or vertex/texture/normal.
      const std::string_view vertex = field.substr(0, field.find('/'));
      const std::optional<std::int64_t> number = whole_number_in(vertex);
      if (!number || *number == 0) {
        reader_.fail_line("has " + in_quotes(field) +
                          " where a face's vertex is due, numbered from 1" + export_again);
      }
      const auto known = static_cast<std::int64_t>(mesh_.points.size());
      const std::int64_t index = *number > 0 ? *number - 1 : known + *number;
      if (index < 0 || index >= std::numeric_limits<std::int32_t>::max()) {
        reader_.fail_line("names vertex " + std::to_string(*number) + ", but there are " +
                          std::to_string(known) + " up to it" + export_again);
      }
      // A vertex may stand after the faces that name it.
      if (index > largest_index_) {
        largest_index_ = index;
        largest_index_line_ = reader_.line_number();
      }
      corners_.push_back(static_cast<std::int32_t>(index));
    }
    add_fan(corners_.data(), corners_.size(), mesh_.triangles);
  }

  ByteReader& reader_;
  IndexedMesh mesh_;
  std::vector<std::int32_t> corners_;
  bool has_faces_ = false;
  std::int64_t largest_index_ = -1;
  std::size_t largest_index_line_ = 0;
};

}  // namespace

IndexedMesh read_obj(ByteReader& reader) { return ObjReader(reader).read(); }

}  // namespace wscvt
