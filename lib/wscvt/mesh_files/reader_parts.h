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

/// Adds the fan of a polygon with valid corners. Skips polygons with fewer than three corners.
template <class Index>
void add_fan(const Index* corners, std::size_t count, std::vector<Triangle>& triangles) {
  for (std::size_t i = 2; i < count; ++i) {
    triangles.push_back({static_cast<std::int32_t>(corners[0]),
                         static_cast<std::int32_t>(corners[i - 1]),
                         static_cast<std::int32_t>(corners[i])});
  }
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

/// Adds the triangles of the polygons or strips, with corners counted from `first`, and appends the
/// number of its polygon, from `cell` on, for each triangle. Throws
/// Error(InputOutput) if a corner is not below `points` or the ends do not ascend.
void add_polygons(const VtkPolygons& polygons, bool strips, std::size_t first, std::size_t points,
                  const ByteReader& reader, std::vector<Triangle>& triangles, std::size_t cell,
                  std::vector<std::size_t>& cells);

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
/// different, and each has the faces of a closed surface on the mean.
inline void append_labels(const std::vector<double>& labels, std::size_t faces,
                          std::vector<NamedFaces>& lists) {
  constexpr double most = 9007199254740992.0;  // whole in a double
  constexpr std::size_t fewest_faces = 4;
  if (labels.size() != faces) return;
  std::map<std::int64_t, std::int32_t> numbers;
  NamedFaces names;
  for (const double label : labels) {
    if (!(std::abs(label) <= most) || std::floor(label) != label) return;
    const auto value = static_cast<std::int64_t>(label);
    const auto [known, is_new] =
        numbers.emplace(value, static_cast<std::int32_t>(names.names.size()));
    if (is_new) names.names.push_back(std::to_string(value));
    if (names.names.size() * fewest_faces > faces) return;
    names.of_face.push_back(known->second);
  }
  if (names.names.size() > 1) lists.push_back(std::move(names));
}

}  // namespace wscvt
