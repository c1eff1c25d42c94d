// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/reader_parts.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>

namespace wscvt {

std::vector<Triangle> split_polygon(const std::vector<Vector3>& corners) {
  // Ears cost the square of the corners and more: beyond this a polygon is taken for convex.
  constexpr std::size_t most_corners = 2000;
  const auto count = static_cast<std::int32_t>(corners.size());
  const auto at = [&](std::int32_t k) -> const Vector3& {
    return corners[static_cast<std::size_t>(k)];
  };
  Vector3 normal = Vector3::Zero();
  for (std::int32_t k = 2; k < count; ++k) {
    normal += (at(k - 1) - at(0)).cross(at(k) - at(0));
  }
  // Above 0: as the polygon.
  const auto turn = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    return (at(b) - at(a)).cross(at(c) - at(a)).dot(normal);
  };
  std::vector<Triangle> triangles;
  bool is_fan = true;
  for (std::int32_t k = 2; k < count; ++k) {
    triangles.push_back({0, k - 1, k});
    if (turn(0, k - 1, k) < 0.0) is_fan = false;
  }
  if (is_fan || corners.size() > most_corners) return triangles;
  triangles.clear();
  std::vector<std::int32_t> left(corners.size());
  std::iota(left.begin(), left.end(), 0);
  const auto ear_at = [&](std::size_t k) -> Triangle {
    const std::size_t n = left.size();
    return {left[(k + n - 1) % n], left[k], left[(k + 1) % n]};
  };
  const auto is_free = [&](const Triangle& t) {
    return std::none_of(left.begin(), left.end(), [&](std::int32_t p) {
      // An outline around a hole passes some points twice.
      if (at(p) == at(t[0]) || at(p) == at(t[1]) || at(p) == at(t[2])) return false;
      return turn(t[0], t[1], p) >= 0.0 && turn(t[1], t[2], p) >= 0.0 && turn(t[2], t[0], p) >= 0.0;
    });
  };
  while (left.size() > 3) {
    std::size_t ear = 0;
    const auto is_ear = [&](std::size_t k) {
      const Triangle t = ear_at(k);
      return turn(t[0], t[1], t[2]) > 0.0 && is_free(t);
    };
    while (ear < left.size() && !is_ear(ear)) ++ear;
    if (ear == left.size()) ear = 1;  // an outline that crosses itself, or a straight rest
    triangles.push_back(ear_at(ear));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

void add_polygons(const VtkPolygons& polygons, bool strips, std::size_t first,
                  const ByteReader& reader, IndexedMesh& mesh, std::size_t cell,
                  std::vector<std::size_t>& cells) {
  const std::size_t points = mesh.points.size() - first;
  reader.check_count(mesh.points.size(), "has more points");
  std::vector<std::int64_t> corners;
  corners.reserve(polygons.corners.size());
  for (const std::int64_t corner : polygons.corners) {
    if (corner < 0 || static_cast<std::uint64_t>(corner) >= points) {
      reader.fail("has a face that names point " + std::to_string(corner) + ", but holds " +
                  std::to_string(points) + ", numbered from 0");
    }
    corners.push_back(corner + static_cast<std::int64_t>(first));
  }
  std::int64_t begin = 0;
  std::vector<std::int64_t> polygon;
  for (const std::int64_t end : polygons.ends) {
    if (end < begin || static_cast<std::uint64_t>(end) > corners.size()) {
      reader.fail("has faces whose corners do not follow each other");
    }
    if (strips) {
      add_strip(corners.data() + begin, static_cast<std::size_t>(end - begin), mesh.triangles);
    } else {
      polygon.assign(corners.begin() + begin, corners.begin() + end);
      add_polygon(polygon, mesh.points, mesh.triangles);
    }
    cells.resize(mesh.triangles.size(), cell++);
    begin = end;
  }
}

namespace {

constexpr std::int64_t vtk_strip = 6;
constexpr std::int64_t vtk_pixel = 8;

/// Returns the number of corners of a cell with `nodes` nodes, which come first among them; 0 if it
/// is no surface. The numbers of types are those of vtkCellType.h.
std::int64_t surface_corners(std::int64_t type, std::int64_t nodes) {
  switch (type) {
    case 5:   // triangle
    case 22:  // quadratic
    case 34:  // biquadratic
    case 69:  // of Lagrange
    case 76:  // of Bezier
      return std::min<std::int64_t>(3, nodes);
    case vtk_strip:
    case 7:  // polygon
      return nodes;
    case vtk_pixel:
    case 9:   // quadrilateral
    case 23:  // quadratic
    case 28:  // biquadratic
    case 30:  // quadratic along two edges
    case 70:  // of Lagrange
    case 77:  // of Bezier
      return std::min<std::int64_t>(4, nodes);
    case 36:  // polygon with a node on each edge
      return nodes / 2;
    default:
      return 0;
  }
}

}  // namespace

void add_surface_cells(const VtkPolygons& grid, const std::vector<std::int64_t>& types,
                       std::size_t first, const ByteReader& reader, IndexedMesh& mesh,
                       std::vector<std::size_t>& cells) {
  if (types.size() != grid.ends.size()) {
    reader.fail("has " + std::to_string(types.size()) + " types of " +
                std::to_string(grid.ends.size()) + " cells");
  }
  std::array<VtkPolygons, 2> surfaces;  // faces, and strips
  std::array<std::vector<std::size_t>, 2> numbers;
  std::int64_t begin = 0;
  for (std::size_t k = 0; k < types.size(); ++k) {
    const std::int64_t end = grid.ends[k];
    if (end < begin || static_cast<std::uint64_t>(end) > grid.corners.size()) {
      reader.fail("has cells whose corners do not follow each other");
    }
    const std::int64_t count = surface_corners(types[k], end - begin);
    if (count > 0) {
      VtkPolygons& to = surfaces[types[k] == vtk_strip ? 1 : 0];
      const auto from = grid.corners.begin() + begin;
      to.corners.insert(to.corners.end(), from, from + count);
      // A pixel's corners are those of two rows, not a way around it.
      if (types[k] == vtk_pixel && count == 4)
        std::swap(*(to.corners.end() - 1), *(to.corners.end() - 2));
      to.ends.push_back(static_cast<std::int64_t>(to.corners.size()));
      numbers[types[k] == vtk_strip ? 1 : 0].push_back(k);
    }
    begin = end;
  }
  for (const std::size_t strips : {0, 1}) {
    std::size_t t = cells.size();
    add_polygons(surfaces[strips], strips == 1, first, reader, mesh, 0, cells);
    for (; t < cells.size(); ++t) cells[t] = numbers[strips][cells[t]];
  }
}

void add_values_of_cells(const std::vector<double>& values, std::size_t width,
                         const std::vector<std::size_t>& cells, std::vector<double>& result) {
  for (const std::size_t cell : cells) {
    for (std::size_t k = width * cell; k < width * (cell + 1) && k < values.size(); ++k) {
      result.push_back(values[k]);
    }
  }
}

}  // namespace wscvt
