// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>

#include "wscvt/base/error.h"

namespace wscvt {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

std::vector<TrianglePair> self_intersections(const IndexedMesh& mesh) {
  SurfaceMesh surface;
  surface.reserve(static_cast<SurfaceMesh::size_type>(mesh.points.size()),
                  static_cast<SurfaceMesh::size_type>(3 * mesh.triangles.size() / 2),
                  static_cast<SurfaceMesh::size_type>(mesh.triangles.size()));
  for (const Vector3& p : mesh.points) surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  using Vertex = SurfaceMesh::Vertex_index;
  const auto vertex = [](std::int32_t v) { return Vertex(static_cast<SurfaceMesh::size_type>(v)); };
  for (const auto& [a, b, c] : mesh.triangles) {
    // A face that cannot be added is what makes the mesh no manifold.
    if (surface.add_face(vertex(a), vertex(b), vertex(c)) == SurfaceMesh::null_face()) {
      throw Error(ErrorCode::InvalidInput,
                  "The mesh is no oriented 2-manifold, so that it cannot be checked for "
                  "self-intersections; mend it first.");
    }
  }
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  std::vector<TrianglePair> pairs;
  pairs.reserve(found.size());
  for (const auto& [first, second] : found) {
    const auto a = static_cast<std::int32_t>(first.idx());
    const auto b = static_cast<std::int32_t>(second.idx());
    pairs.emplace_back(std::minmax(a, b));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool triangles_meet(const std::vector<Vector3>& points, const Triangle& a, const Triangle& b) {
  const auto point = [&](std::int32_t v) {
    return Kernel::Point_3(points[v].x(), points[v].y(), points[v].z());
  };
  const auto triangle = [&](const Triangle& t) {
    return Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2]));
  };
  const auto is_in = [](const Triangle& t, std::int32_t v) {
    return std::find(t.begin(), t.end(), v) != t.end();
  };
  int shared = 0;
  for (const std::int32_t v : a) shared += is_in(b, v) ? 1 : 0;
  if (shared == 0) return CGAL::do_intersect(triangle(a), triangle(b));
  if (shared > 1) return false;
  // They meet in more than the corner where the far side of one passes through the other.
  const auto far_side = [&](const Triangle& t, const Triangle& other) {
    std::size_t k = 0;
    while (!is_in(other, t[k])) ++k;
    return Kernel::Segment_3(point(t[(k + 1) % 3]), point(t[(k + 2) % 3]));
  };
  return CGAL::do_intersect(far_side(a, b), triangle(b)) ||
         CGAL::do_intersect(far_side(b, a), triangle(a));
}

std::vector<std::int32_t> vertices_of(const std::vector<TrianglePair>& pairs,
                                      const std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> vertices;
  for (const auto& [a, b] : pairs) {
    vertices.insert(vertices.end(), triangles[a].begin(), triangles[a].end());
    vertices.insert(vertices.end(), triangles[b].begin(), triangles[b].end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace wscvt
