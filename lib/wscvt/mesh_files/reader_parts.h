// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Splits a polygon of four or more corners into triangles of their numbers: those at its first
/// corner unless one of them turns over, else ears, so that a concave polygon keeps its area.
std::vector<Triangle> split_polygon(const std::vector<Vector3>& corners);

/// Calls take(k) with the three places among the corners of each triangle of a polygon. Corners may
/// name points that are not known yet; such a polygon is taken for convex.
template <class Index, class Take>
void for_each_triangle(const std::vector<Index>& corners, const std::vector<Vector3>& points,
                       const Take& take) {
  if (corners.size() == 3) take(Triangle{0, 1, 2});
  if (corners.size() < 4) return;
  std::vector<Vector3> places;
  for (const Index corner : corners) {
    const auto k = static_cast<std::size_t>(corner);
    places.push_back(k < points.size() ? points[k] : Vector3::Zero());
  }
  for (const Triangle& t : split_polygon(places)) take(t);
}

/// Adds the triangles of a polygon. Skips polygons with fewer than three corners.
template <class Index>
void add_polygon(const std::vector<Index>& corners, const std::vector<Vector3>& points,
                 std::vector<Triangle>& triangles) {
  const auto corner = [&](std::int32_t k) {
    return static_cast<std::int32_t>(corners[static_cast<std::size_t>(k)]);
  };
  for_each_triangle(corners, points, [&](const Triangle& t) {
    triangles.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
  });
}

/// Adds the triangles of a strip and turns every second one. Skips triangles without three
/// different corners, which join strips.
template <class Index>
void add_strip(const Index* corners, std::size_t count, std::vector<Triangle>& triangles) {
  for (std::size_t i = 2; i < count; ++i) {
    const std::size_t odd = i % 2;
    const Triangle t{static_cast<std::int32_t>(corners[i - 2 + odd]),
                     static_cast<std::int32_t>(corners[i - 1 - odd]),
                     static_cast<std::int32_t>(corners[i])};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
}

/// Lists of corners as in VTK: all corners in one array, and the end of each list.
struct VtkPolygons {
  std::vector<std::int64_t> corners;
  std::vector<std::int64_t> ends;
};

/// Adds the triangles of the polygons or strips to a mesh, whose points from `first` on they number
/// from 0, and appends the number of its polygon, from `cell` on, for each triangle. Throws
/// Error(InputOutput) if there is no such point or the ends do not ascend.
void add_polygons(const VtkPolygons& polygons, bool strips, std::size_t first,
                  const ByteReader& reader, IndexedMesh& mesh, std::size_t cell,
                  std::vector<std::size_t>& cells);

/// Adds the triangles of the surface cells of an unstructured grid, as add_polygons() does: of
/// triangles, quadrilaterals, polygons and strips, of those of higher order by their corners.
/// `types`: VTK's number of each cell's type. Leaves out vertices, lines and bodies. Throws as
/// add_polygons(), and for another number of types than of cells.
void add_surface_cells(const VtkPolygons& grid, const std::vector<std::int64_t>& types,
                       std::size_t first, const ByteReader& reader, IndexedMesh& mesh,
                       std::vector<std::size_t>& cells);

/// Appends the values of cells, `width` for each, as far as there are any.
void add_values_of_cells(const std::vector<double>& values, std::size_t width,
                         const std::vector<std::size_t>& cells, std::vector<double>& result);

/// Collects the names of faces while a file is read.
class FaceNames {
 public:
  /// The faces from now on have this name. A name may come again.
  void begin(const std::string& name) {
    const auto [known, is_new] =
        numbers_.emplace(name, static_cast<std::int32_t>(names_.names.size()));
    if (is_new) names_.names.push_back(name);
    current_ = known->second;
  }

  /// The faces from now on are a set of their own, also if another has the same name.
  void begin_new(const std::string& name) {
    current_ = static_cast<std::int32_t>(names_.names.size());
    names_.names.push_back(name);
  }

  /// Gives the current name to all faces up to this number of them.
  void add_to(std::size_t faces) {
    if (names_.names.empty()) {
      unnamed_ = faces;
      return;
    }
    if (names_.of_face.empty()) names_.of_face.resize(unnamed_, -1);
    names_.of_face.resize(faces, current_);
  }

  /// Appends the names if there are at least two.
  void append_to(std::vector<NamedFaces>& lists) {
    if (names_.names.size() > 1 && !names_.of_face.empty()) lists.push_back(std::move(names_));
  }

 private:
  NamedFaces names_;
  std::map<std::string, std::int32_t, std::less<>> numbers_;
  std::int32_t current_ = -1;
  std::size_t unnamed_ = 0;  ///< faces before the first name
};

/// Appends the labels of a file's triangles as names, if all are whole numbers, at least two are
/// different, and each has the faces of a closed surface on the mean. Two labels a triangle are
/// those of its sides, as DREAM.3D and VTK's surface nets have them: they differ, those below 1 are
/// void, and some are.
inline void append_labels(const std::vector<double>& labels, std::size_t faces,
                          std::vector<NamedFaces>& lists) {
  constexpr double most = 9007199254740992.0;  // whole in a double
  constexpr std::size_t fewest_faces = 4;
  const bool have_sides = faces > 0 && labels.size() == 2 * faces;
  if (!have_sides && labels.size() != faces) return;
  bool has_void = false;
  std::map<std::int64_t, std::int32_t> numbers;
  NamedFaces names;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const double label = labels[k];
    if (!(std::abs(label) <= most) || std::floor(label) != label) return;
    const auto value = static_cast<std::int64_t>(label);
    const bool is_other = have_sides && k % 2 == 1;
    if (is_other && label == labels[k - 1]) return;
    if (have_sides && value < 1) {
      has_void = true;
      names.of_face.push_back(-1);
      continue;
    }
    const auto [known, is_new] =
        numbers.emplace(value, static_cast<std::int32_t>(names.names.size()));
    if (is_new) names.names.push_back(std::to_string(value));
    if (names.names.size() * fewest_faces > labels.size()) return;
    names.of_face.push_back(known->second);
  }
  if (names.names.size() > 1 && has_void == have_sides) lists.push_back(std::move(names));
}

}  // namespace wscvt
