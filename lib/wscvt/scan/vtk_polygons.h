// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Lists of corners as VTK keeps them: behind each other, and where each ends.
struct VtkPolygons {
  std::vector<std::int64_t> corners;
  std::vector<std::int64_t> ends;
};

/// Adds their triangles, or those of strips, with corners counted from `first` on. Throws
/// Error(InputOutput) for corners that are not below `points` and ends that do not ascend.
void add_polygons(const VtkPolygons& polygons, bool strips, std::size_t first, std::size_t points,
                  const ByteReader& reader, std::vector<Triangle>& triangles);

}  // namespace wscvt
