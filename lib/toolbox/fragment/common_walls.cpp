// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fragment/common_walls.h"

#include <algorithm>
#include <map>
#include <utility>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/sorting.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// Returns the closed mesh of a body. `by_body`: the triangles of each.
IndexedMesh mesh_of(const WallComplex& complex, const Groups& by_body, std::size_t body) {
  IndexedMesh mesh;
  std::vector<std::int32_t> used;
  for (const std::int32_t* at = by_body.begin(body); at != by_body.end(body); ++at) {
    const WallTriangle& t = complex.triangles[*at];
    Triangle corners = t.corners;
    if (index(t.inner) != body) std::swap(corners[1], corners[2]);
    mesh.triangles.push_back(corners);
    used.insert(used.end(), corners.begin(), corners.end());
  }
  sort_unique(used);
  for (const std::int32_t v : used) mesh.points.push_back(complex.points[v]);
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& corner : t) {
      corner = static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), corner) -
                                         used.begin());
    }
  }
  return mesh;
}

}  // namespace

std::vector<CommonWall> common_walls(const WallComplex& complex) {
  std::map<std::pair<std::int32_t, std::int32_t>, CommonWall> walls;
  for (const WallTriangle& t : complex.triangles) {
    if (t.outer < 0) continue;
    const Vector3& a = complex.points[t.corners[0]];
    const Vector3& b = complex.points[t.corners[1]];
    const Vector3& c = complex.points[t.corners[2]];
    CommonWall& wall = walls[{t.outer, t.inner}];
    wall.first = t.outer;
    wall.second = t.inner;
    ++wall.triangles;
    const Vector3 normal = doubled_area_normal(a, b, c);
    const double area = 0.5 * normal.norm();
    wall.area += area;
    wall.centre += area / 3.0 * (a + b + c);
    wall.normal -= normal;  // triangles are seen from `outer`, the first
  }
  std::vector<CommonWall> list;
  for (auto& [bodies, wall] : walls) {
    if (wall.area > 0.0) wall.centre /= wall.area;
    wall.normal.normalize();
    list.push_back(wall);
  }
  return list;
}

std::vector<IndexedMesh> body_meshes(const WallComplex& complex, std::size_t bodies) {
  const Groups by_body =
      counting_sort(complex.triangles.size(), bodies, [&](std::size_t t, const auto& visit) {
        const WallTriangle& triangle = complex.triangles[t];
        visit(index(triangle.inner));
        if (triangle.outer >= 0) visit(index(triangle.outer));
      });
  std::vector<IndexedMesh> meshes;
  for (std::size_t body = 0; body < bodies; ++body) {
    meshes.push_back(mesh_of(complex, by_body, body));
  }
  return meshes;
}

double mean_edge_of(const IndexedMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum += (mesh.points[t[k]] - mesh.points[t[following(k)]]).norm();
    }
  }
  return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

}  // namespace wscvt
