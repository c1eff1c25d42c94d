// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/enclosure.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// Large enough that the start of a block costs little.
constexpr std::size_t enclosure_block = 16384;

/// Returns 1 if the projection of edge a b to the plane z = 0 passes above the point (in y) to the
/// right, -1 if to the left, 0 if it does not pass. It is computed from the lower vertex, so both
/// faces of an edge get equal results with opposite signs. For any rounding, each face over a point
/// is counted exactly once.
int passing(const IndexedMesh& mesh, std::int32_t a, std::int32_t b, const Vector3& point) {
  const Vector3& p = mesh.points[index(std::min(a, b))];
  const Vector3& q = mesh.points[index(std::max(a, b))];
  if ((p.x() <= point.x()) == (q.x() <= point.x())) return 0;
  const double share = (point.x() - p.x()) / (q.x() - p.x());
  if (!(p.y() + share * (q.y() - p.y()) > point.y())) return 0;
  return (q.x() > p.x()) == (a < b) ? 1 : -1;
}

}  // namespace

std::vector<char> are_inside(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                             const Execution& execution) {
  // Sorted by x, so that a face finds the points below and above it without testing all.
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return points[i].x() < points[j].x(); });
  struct Windings {
    std::vector<int> of_point;
    Windings& operator+=(const Windings& other) {
      for (std::size_t i = 0; i < of_point.size(); ++i) of_point[i] += other.of_point[i];
      return *this;
    }
  };
  // Each block has a list of all points. Use few blocks, so that many points need no more memory
  // than a mesh.
  const std::size_t block = std::max(enclosure_block, (mesh.triangles.size() + 15) / 16);
  const Windings windings = execution.parallel_sum(
      mesh.triangles.size(), block, Windings{std::vector<int>(points.size(), 0)},
      [&](std::size_t begin, std::size_t end) {
        Windings part{std::vector<int>(points.size(), 0)};
        for (std::size_t f = begin; f < end; ++f) {
          const Triangle& t = mesh.triangles[f];
          const Vector3& a = mesh.points[index(t[0])];
          const Vector3& b = mesh.points[index(t[1])];
          const Vector3& c = mesh.points[index(t[2])];
          const double low = std::min({a.x(), b.x(), c.x()});
          const double high = std::max({a.x(), b.x(), c.x()});
          const auto from =
              std::lower_bound(order.begin(), order.end(), low,
                               [&](std::size_t i, double x) { return points[i].x() < x; });
          for (auto at = from; at != order.end() && points[*at].x() <= high; ++at) {
            const Vector3& p = points[*at];
            int covers = 0;
            for (std::size_t k = 0; k < 3; ++k) covers += passing(mesh, t[k], t[following(k)], p);
            if (covers == 0) continue;
            const Vector3 normal = doubled_area_normal(a, b, c);
            // The face is above the point if the point is on its lower side.
            const double side = normal.dot(p - a) * (normal.z() > 0.0 ? 1.0 : -1.0);
            if (side < 0.0) part.of_point[*at] += covers;
          }
        }
        return part;
      });
  std::vector<char> inside(points.size());
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = windings.of_point[i] != 0 ? 1 : 0;
  return inside;
}

}  // namespace wscvt
