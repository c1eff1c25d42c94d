// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <map>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt::test {

/// The faces, two triangles each, of the voxels from 0 to count - 1 that `holds` says are of a
/// body; of edges 1, with a corner of the first at the origin.
inline IndexedMesh voxel_body(int count, const std::function<bool(int, int, int)>& holds) {
  IndexedMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto corner = [&](const std::array<int, 3>& place) {
    const auto [at, is_new] = numbers.emplace(place, static_cast<std::int32_t>(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(place[0], place[1], place[2]);
    return at->second;
  };
  const auto is_in = [&](const std::array<int, 3>& v) {
    for (const int k : v) {
      if (k < 0 || k >= count) return false;
    }
    return holds(v[0], v[1], v[2]);
  };
  for (int z = 0; z < count; ++z) {
    for (int y = 0; y < count; ++y) {
      for (int x = 0; x < count; ++x) {
        for (std::size_t face = 0; is_in({x, y, z}) && face < 6; ++face) {
          const std::size_t axis = face / 2;
          const int side = static_cast<int>(face % 2);
          std::array<int, 3> next{x, y, z};
          next[axis] += side == 1 ? 1 : -1;
          if (is_in(next)) continue;
          std::array<std::int32_t, 4> quad{};
          constexpr std::array<std::array<int, 2>, 4> round{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
          for (std::size_t k = 0; k < 4; ++k) {
            std::array<int, 3> place{x, y, z};
            place[axis] += side;
            const std::array<int, 2>& step = round[side == 1 ? k : 3 - k];
            place[(axis + 1) % 3] += step[0];
            place[(axis + 2) % 3] += step[1];
            quad[k] = corner(place);
          }
          mesh.triangles.push_back({quad[0], quad[1], quad[2]});
          mesh.triangles.push_back({quad[0], quad[2], quad[3]});
        }
      }
    }
  }
  return mesh;
}

/// An ellipsoid of voxels, whose semi-axes and centre are in voxels.
inline IndexedMesh voxel_ellipsoid(const Vector3& axes, const Vector3& centre, int count) {
  return voxel_body(count, [&](int x, int y, int z) {
    const Vector3 place(x + 0.5, y + 0.5, z + 0.5);
    return (place - centre).cwiseQuotient(axes).squaredNorm() <= 1.0;
  });
}

}  // namespace wscvt::test
