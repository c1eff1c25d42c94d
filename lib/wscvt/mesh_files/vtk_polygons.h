// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

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

}  // namespace wscvt
