// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <numeric>

#include "wscvt/base/error.h"

namespace wscvt {

std::vector<Triangle> convex_hull_triangles(const std::vector<Vector3>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  std::vector<Point> input;
  input.reserve(points.size());
  for (const Vector3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  CGAL::Surface_mesh<Point> hull;
  CGAL::convex_hull_3(input.begin(), input.end(), hull);
  std::vector<Triangle> triangles;
  // Of points in one plane CGAL returns the polygon as one face.
  if (hull.num_vertices() < 4 || hull.num_faces() < 4) return triangles;

  // The hull copies its points: find them again by value.
  std::vector<std::int32_t> order(input.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::int32_t i, std::int32_t j) { return input[i] < input[j]; });
  std::vector<std::int32_t> index_of_hull_vertex(hull.num_vertices());
  for (const auto vertex : hull.vertices()) {
    index_of_hull_vertex[vertex] =
        *std::lower_bound(order.begin(), order.end(), hull.point(vertex),
                          [&](std::int32_t i, const Point& p) { return input[i] < p; });
  }
  // Faces with more than three corners do not come out of convex_hull_3, but its type allows them.
  for (const auto face : hull.faces()) {
    std::vector<std::int32_t> corners;
    for (const auto vertex : hull.vertices_around_face(hull.halfedge(face))) {
      corners.push_back(index_of_hull_vertex[vertex]);
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  // CGAL's order goes by addresses, and with it the last digits of sums over the triangles.
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

IndexedMesh convex_hull(const std::vector<Vector3>& points) {
  IndexedMesh hull;
  hull.triangles = convex_hull_triangles(points);
  if (hull.triangles.empty()) {
    throw Error(
        ErrorCode::InvalidInput,
        "The points lie in one plane, so their convex hull has no volume; give a solid body.");
  }
  std::vector<std::int32_t> number(points.size(), -1);
  for (const Triangle& t : hull.triangles) {
    for (const std::int32_t v : t) number[v] = 0;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<std::int32_t>(hull.points.size());
    hull.points.push_back(points[i]);
  }
  for (Triangle& t : hull.triangles) {
    for (std::int32_t& v : t) v = number[v];
  }
  return hull;
}

}  // namespace wscvt
