// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/readers.h"
#include "wscvt/mesh_files/table_heading.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

namespace {

/// Returns the axis of a column, or nothing for other columns.
std::optional<std::size_t> axis_of(std::string_view name) {
  const std::string lower = lower_case(name);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (lower == std::string(1, "xyz"[axis]) || lower == "points:" + std::to_string(axis) ||
        lower == "points_" + std::to_string(axis)) {
      return axis;
    }
  }
  return {};
}

/// Sets the columns of x, y and z by a heading.
void read_heading(std::string_view line, const ByteReader& reader,
                  std::array<std::size_t, 3>& columns) {
  const std::vector<TableHeading> headings = read_headings(line);
  std::array<int, 3> found{};
  std::vector<std::string> units;
  for (std::size_t column = 0; column < headings.size(); ++column) {
    if (const std::optional<std::size_t> axis = axis_of(headings[column].name)) {
      columns[*axis] = column;
      units.push_back(headings[column].unit);
      ++found[*axis];
    }
  }
  if (found != std::array<int, 3>{1, 1, 1}) {
    reader.refuse_line(
        "is not a point and does not name the columns x, y and z, each once. Name them, or "
        "give a file with numbers only.");
  }
  const std::string fault = common_unit(units).fault;
  if (!fault.empty()) reader.refuse_line(fault);
}

}  // namespace

void read_point_text(ByteReader& reader, MeshFile& file) {
  std::array<std::size_t, 3> columns{0, 1, 2};
  std::vector<std::string_view> fields;
  IndexedMesh& mesh = file.mesh;
  bool is_first = true;
  bool has_heading = false;
  std::size_t counted = 0;  // points whose first number is theirs
  while (const std::optional<std::string_view> line = reader.filled_line()) {
    if (TextFields(*line).next().front() == '#') continue;
    if (is_first && names_separator(*line)) continue;
    split_fields(*line, fields);
    if (is_first && !number_in_row(fields[0], *line) && !fields[0].empty()) {
      is_first = false;
      read_heading(*line, reader, columns);
      has_heading = true;
      continue;
    }
    is_first = false;
    reader.check_count(mesh.points.size() + 1, "holds more points");
    const std::optional<double> first =
        fields.size() > 3 ? number_in_row(fields[0], *line) : std::nullopt;
    const auto number = static_cast<double>(mesh.points.size());
    if (first == number || first == number + 1.0) ++counted;
    Vector3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view field = columns[axis] < fields.size() ? fields[columns[axis]] : "";
      const std::optional<double> value = number_in_row(field, *line);
      if (!value) {
        reader.fail_line((field.empty() ? "lacks" : "has " + in_quotes(field) + " instead of") +
                         std::string(" the coordinate ") + "xyz"[axis] + " of a point");
      }
      point[static_cast<Eigen::Index>(axis)] = *value;
    }
    mesh.points.push_back(point);
  }
  constexpr std::size_t enough = 10;
  if (!has_heading && counted >= enough && counted == mesh.points.size()) {
    reader.refuse(
        "has the number of each point before it, which would be its x. Write a heading that names "
        "the columns, such as id,x,y,z.");
  }
  if (mesh.points.empty()) reader.fail("holds no points");
}

}  // namespace wscvt
