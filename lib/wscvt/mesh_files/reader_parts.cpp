// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/reader_parts.h"

#include <limits>
#include <string>

namespace wscvt {

void add_polygons(const VtkPolygons& polygons, bool strips, std::size_t first, std::size_t points,
                  const ByteReader& reader, std::vector<Triangle>& triangles, std::size_t cell,
                  std::vector<std::size_t>& cells) {
  if (first + points > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    reader.fail("has more points than can be numbered. Reduce the scan first.");
  }
  std::vector<std::int64_t> corners;
  corners.reserve(polygons.corners.size());
  for (const std::int64_t corner : polygons.corners) {
    if (corner < 0 || static_cast<std::uint64_t>(corner) >= points) {
      reader.fail("has a face that names point " + std::to_string(corner) + ", but holds " +
                  std::to_string(points) + ", numbered from 0" + export_again);
    }
    corners.push_back(corner + static_cast<std::int64_t>(first));
  }
  std::int64_t begin = 0;
  for (const std::int64_t end : polygons.ends) {
    if (end < begin || static_cast<std::uint64_t>(end) > corners.size()) {
      reader.fail("has faces whose corners do not follow each other" + std::string(export_again));
    }
    const auto count = static_cast<std::size_t>(end - begin);
    if (strips) {
      add_strip(corners.data() + begin, count, triangles);
    } else {
      add_fan(corners.data() + begin, count, triangles);
    }
    cells.resize(triangles.size(), cell++);
    begin = end;
  }
}

}  // namespace wscvt
