// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

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

}  // namespace wscvt
