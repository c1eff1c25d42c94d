// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/crossing_pairs.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <vector>

#include "wscvt/base/triangle_geometry.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

CrossingPairs crossing_pairs(const IndexedMesh& mesh, const Execution& execution) {
  // Finds 5 of the faces of a dent that has a hundredth of them.
  constexpr std::size_t most_asked = 500;
  // Boxes of more would take more memory than the rest of a run.
  constexpr std::size_t most_faces = 2000000;
  const std::size_t faces = mesh.triangles.size();
  if (faces > most_faces) return {0, false};
  if (faces <= most_asked) return {self_intersections(mesh, execution).size(), true};
  using FaceBox = CGAL::Box_intersection_d::Box_with_info_d<float, 3, std::int32_t>;
  const auto corner = [&](std::size_t f, std::size_t k) -> const Vector3& {
    return mesh.points[static_cast<std::size_t>(mesh.triangles[f][k])];
  };
  const auto has_area = [&](std::size_t f) {
    return doubled_area_normal(corner(f, 0), corner(f, 1), corner(f, 2)).norm() > 0.0;
  };
  // About a point of the mesh, and a little larger, because floats have few digits.
  const Vector3 origin = corner(0, 0);
  const auto box_of = [&](std::size_t f) {
    const Vector3 low = corner(f, 0).cwiseMin(corner(f, 1)).cwiseMin(corner(f, 2)) - origin;
    const Vector3 high = corner(f, 0).cwiseMax(corner(f, 1)).cwiseMax(corner(f, 2)) - origin;
    float least[3];
    float most[3];
    for (int k = 0; k < 3; ++k) {
      constexpr double rounding = 1e-6;
      least[k] = static_cast<float>(low[k] - rounding * std::abs(low[k]));
      most[k] = static_cast<float>(high[k] + rounding * std::abs(high[k]));
    }
    return FaceBox(least, most, static_cast<std::int32_t>(f));
  };
  std::vector<FaceBox> all;
  std::vector<FaceBox> asked;
  all.reserve(faces);
  for (std::size_t f = 0; f < faces; ++f) all.push_back(box_of(f));
  for (std::size_t k = 0; k < most_asked; ++k) {
    const std::size_t f = k * faces / most_asked;
    if (has_area(f)) asked.push_back(all[f]);
  }
  std::vector<TrianglePair> pairs;
  CGAL::box_intersection_d(
      asked.begin(), asked.end(), all.begin(), all.end(), [&](const FaceBox& a, const FaceBox& b) {
        const auto f = static_cast<std::size_t>(a.info());
        const auto g = static_cast<std::size_t>(b.info());
        if (f != g && has_area(g) &&
            triangles_meet(mesh.points, mesh.triangles[f], mesh.triangles[g])) {
          pairs.emplace_back(std::minmax(a.info(), b.info()));
        }
      });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return {pairs.size(), false};
}

std::string crossing_sentence(const CrossingPairs& pairs, const std::string& whose) {
  if (pairs.count == 0) return "";
  return (pairs.is_all ? "" : "At least ") + std::to_string(pairs.count) +
         (pairs.count == 1 ? " pair" : " pairs") + " of triangles of " + whose +
         " intersect. Where one sheet passes through another, the surface is not that of a body, "
         "and its volume is counted twice or not at all. Repair it there first.";
}

}  // namespace wscvt
