// SPDX-License-Identifier: GPL-3.0-or-later
#include "grains/handled_body.h"

#include <algorithm>
#include <cmath>

#include "grains/marching_cubes.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt::test {

IndexedMesh body_of_depth(const std::function<double(const Vector3&)>& depth) {
  VoxelGrid grid;
  grid.spacing = 0.04;
  grid.origin = Vector3(-1.507, -1.511, -1.513);
  grid.size = {76, 76, 76};
  for (int z = 0; z < grid.size[2]; ++z) {
    for (int y = 0; y < grid.size[1]; ++y) {
      for (int x = 0; x < grid.size[0]; ++x) {
        grid.values.push_back(depth(grid.origin + grid.spacing * Vector3(x, y, z)));
      }
    }
  }
  return check_mesh(marching_cubes(grid, 0.0), {}, Execution(1)).mesh;
}

double ball(const Vector3& p) { return 1.0 - p.norm(); }

double bridge(const Vector3& p) {
  const Vector3 q = p - Vector3(1.0, 0.0, 0.0);
  return 0.08 - std::hypot(std::hypot(q.x(), q.z()) - 0.3, q.y());
}

double drilled(const Vector3& p) {
  return std::min(ball(p), std::hypot(p.x() + 0.8, p.y()) - 0.07);
}

IndexedMesh ball_with_a_bridge() {
  return body_of_depth([](const Vector3& p) { return std::max(ball(p), bridge(p)); });
}

IndexedMesh ball_with_a_tunnel() { return body_of_depth(drilled); }

}  // namespace wscvt::test
