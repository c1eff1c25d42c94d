// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

MeshSums mesh_sums(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                   const Vector3& origin, const Execution& execution) {
  constexpr std::size_t block_size = 16384;
  return execution.parallel_sum(
      triangles.size(), block_size, MeshSums(), [&](std::size_t begin, std::size_t end) {
        MeshSums part;
        for (std::size_t f = begin; f < end; ++f) {
          const auto& [a, b, c] = triangles[f];
          part.add(points[a] - origin, points[b] - origin, points[c] - origin);
        }
        return part;
      });
}

std::vector<Vector3> vertex_normals(const std::vector<Vector3>& points,
                                    const std::vector<Triangle>& triangles) {
  std::vector<Vector3> normals(points.size(), Vector3::Zero());
  for (const Triangle& t : triangles) {
    const Vector3 normal = doubled_area_normal(points[t[0]], points[t[1]], points[t[2]]);
    for (const std::int32_t v : t) normals[v] += normal;
  }
  for (Vector3& normal : normals) {
    const double length = normal.norm();
    if (length > 0.0) normal /= length;
  }
  return normals;
}

std::vector<double> vertex_areas(const IndexedMesh& mesh) {
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const double third = triangle_area(mesh.points[a], mesh.points[b], mesh.points[c]) / 3.0;
    areas[a] += third;
    areas[b] += third;
    areas[c] += third;
  }
  return areas;
}

}  // namespace wscvt
