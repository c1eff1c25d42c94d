// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "wscvt/base/error.h"

namespace wscvt {

IndexedMesh convex_hull(const std::vector<Vector3>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using HullMesh = CGAL::Surface_mesh<Kernel::Point_3>;
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  for (const Vector3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  HullMesh hull;
  CGAL::convex_hull_3(input.begin(), input.end(), hull);

  IndexedMesh result;
  for (const auto vertex : hull.vertices()) {
    const Kernel::Point_3& p = hull.point(vertex);
    result.points.emplace_back(p.x(), p.y(), p.z());
  }
  // Faces with more than three corners do not come out of convex_hull_3, but its type allows them.
  for (const auto face : hull.faces()) {
    std::vector<std::int32_t> corners;
    for (const auto vertex : hull.vertices_around_face(hull.halfedge(face))) {
      corners.push_back(static_cast<std::int32_t>(vertex.idx()));
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      result.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  if (result.triangles.size() < 4) {
    throw Error(
        ErrorCode::InvalidInput,
        "The points lie in one plane, so their convex hull has no volume; give a solid body.");
  }
  return result;
}

}  // namespace wscvt
