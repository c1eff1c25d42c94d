// SPDX-License-Identifier: GPL-3.0-or-later
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/reader_parts.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

/// Returns the next line with more than a comment.
std::optional<std::string_view> next_line(ByteReader& reader) {
  while (const std::optional<std::string_view> line = reader.line()) {
    const std::string_view text = line->substr(0, line->find('#'));
    if (!TextFields(text).next().empty()) return text;
  }
  return {};
}

/// Checks the header's keyword, [ST][C][N][4][n]OFF. Normals and the like follow the three
/// coordinates. Refuses 4 and n, which change the number of coordinates.
void check_keyword(ByteReader& reader, std::string_view keyword) {
  const std::string form(keyword.substr(0, keyword.find("OFF")));
  if (keyword.find("OFF") == std::string_view::npos || keyword.substr(form.size()) != "OFF" ||
      form.find_first_not_of("STCN4n") != std::string::npos) {
    reader.fail("does not begin with the word \"OFF\" and is not an OFF file");
  }
  if (form.find_first_of("4n") != std::string::npos) {
    reader.refuse("has coordinates that are not in three dimensions (" + in_quotes(keyword) +
                  "). Export it as plain OFF.");
  }
}

std::size_t whole_number(ByteReader& reader, std::string_view field, const std::string& due) {
  const std::optional<std::int64_t> value = whole_number_in(field);
  if (!value || *value < 0) {
    reader.fail_line((field.empty() ? "lacks " : "has " + in_quotes(field) + " instead of ") + due);
  }
  return static_cast<std::size_t>(*value);
}

[[noreturn]] void fail_cut(ByteReader& reader, const std::string& what, std::size_t number,
                           std::size_t count) {
  reader.fail("ends before " + what + " " + std::to_string(number) + " of " +
              std::to_string(count) + ". It was cut off");
}

}  // namespace

void read_off(ByteReader& reader, MeshFile& file) {
  std::optional<std::string_view> line = next_line(reader);
  TextFields header(line.value_or(""));
  check_keyword(reader, header.next());
  std::string_view field = header.next();
  if (field == "BINARY") {
    reader.refuse("is a binary OFF file, which is not supported. Export it as text, or as PLY.");
  }
  if (field.empty()) {  // the counts may be beside the keyword or below it
    line = next_line(reader);
    header = TextFields(line.value_or(""));
    field = header.next();
  }
  const std::size_t vertices = whole_number(reader, field, "the number of vertices");
  const std::size_t faces = whole_number(reader, header.next(), "the number of faces");
  reader.check_count(vertices, "declares more vertices");
  // The shortest vertex is "0 0 0" and a line break, the shortest face "0" and a line break. The
  // last line needs no line break. Refuses a header that declares more than fits.
  const std::uintmax_t left = reader.remaining() + 1;
  if (vertices > left / 6 || faces > (left - 6 * vertices) / 2) {
    reader.fail("declares " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                " faces, but only " + std::to_string(reader.remaining()) +
                " bytes are left for them. It was cut off");
  }

  IndexedMesh& mesh = file.mesh;
  mesh.points.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    if (!(line = next_line(reader))) fail_cut(reader, "vertex", i, vertices);
    TextFields fields(*line);
    Vector3 point;
    for (double& coordinate : point) {
      field = fields.next();
      const std::optional<double> value = number_in(field);
      if (!value) {
        reader.fail_line("(vertex " + std::to_string(i) + ") " +
                         (field.empty() ? "lacks" : "has " + in_quotes(field) + " instead of") +
                         " a coordinate");
      }
      coordinate = *value;
    }
    mesh.points.push_back(point);
  }
  mesh.triangles.reserve(faces);
  std::vector<std::size_t> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    if (!(line = next_line(reader))) fail_cut(reader, "face", f, faces);
    TextFields fields(*line);
    const std::size_t count = whole_number(reader, fields.next(), "a face's number of corners");
    // A corner needs a digit and a blank.
    if (count > (fields.rest().size() + 1) / 2) {
      reader.fail_line("(face " + std::to_string(f) + ") claims " + std::to_string(count) +
                       " corners, more than it names");
    }
    corners.resize(count);
    for (std::size_t& corner : corners) {
      corner = whole_number(reader, fields.next(), "a face's vertex");
      if (corner >= vertices) {
        reader.fail_line("(face " + std::to_string(f) + ") names vertex " + std::to_string(corner) +
                         ", but the file holds " + std::to_string(vertices) + ", numbered from 0");
      }
    }
    add_polygon(corners, mesh.points, mesh.triangles);
  }
  if (faces > 0 && mesh.triangles.empty()) {
    reader.fail("has faces, but none of them has three corners");
  }
}

}  // namespace wscvt
