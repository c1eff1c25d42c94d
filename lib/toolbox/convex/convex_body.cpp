// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/convex_body.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

double ConvexBody::excess(const Vector3& point) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector4d& plane : planes) {
    most = std::max(most, plane.head<3>().dot(point) - plane[3]);
  }
  return most;
}

namespace {

ConvexBody body_of(IndexedMesh hull) {
  ConvexBody body;
  const Vector3 middle = hull.points.front();
  for (const auto& [a, b, c] : hull.triangles) {
    const Vector3 normal = doubled_area_normal(hull.points[a], hull.points[b], hull.points[c]);
    body.volume +=
        six_volumes(hull.points[a] - middle, hull.points[b] - middle, hull.points[c] - middle) /
        6.0;
    // The normal of a needle is only rounding; its neighbours bound the body there.
    constexpr double thinnest = 1e-6;
    const double longest = std::max({(hull.points[b] - hull.points[a]).squaredNorm(),
                                     (hull.points[c] - hull.points[b]).squaredNorm(),
                                     (hull.points[a] - hull.points[c]).squaredNorm()});
    if (!(normal.norm() > thinnest * longest)) continue;
    const Vector3 unit = normal.normalized();
    Eigen::Vector4d plane;
    plane << unit, unit.dot(hull.points[a]);
    body.planes.push_back(plane);
  }
  body.hull = std::move(hull);
  return body;
}

}  // namespace

ConvexBody convex_body(const std::vector<Vector3>& points) {
  if (points.size() < 4) return {};
  const std::vector<Triangle> triangles = convex_hull_triangles(points);
  if (triangles.empty()) return {};
  // Only the points that the triangles use.
  std::vector<std::int32_t> number(points.size(), -1);
  IndexedMesh hull;
  for (Triangle t : triangles) {
    for (std::int32_t& v : t) {
      if (number[v] < 0) {
        number[v] = static_cast<std::int32_t>(hull.points.size());
        hull.points.push_back(points[v]);
      }
      v = number[v];
    }
    hull.triangles.push_back(t);
  }
  return body_of(std::move(hull));
}

namespace {

/// Adds the point farthest from the span of the chosen points.
void add_spanning_point(const std::vector<Vector3>& points, std::vector<Vector3>& chosen) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 d = points[i] - chosen[0];
    double size = d.norm();
    if (chosen.size() == 2) size = d.cross((chosen[1] - chosen[0]).normalized()).norm();
    if (chosen.size() == 3) {
      const Vector3 normal = (chosen[1] - chosen[0]).cross(chosen[2] - chosen[0]);
      size = std::abs(d.dot(normal.normalized()));
    }
    if (!(size > most)) continue;
    most = size;
    best = i;
  }
  chosen.push_back(points[best]);
}

}  // namespace

ConvexBody with_fewer_faces(const ConvexBody& body, int faces) {
  if (body.hull.triangles.size() <= static_cast<std::size_t>(faces)) return body;
  const std::vector<Vector3>& points = body.hull.points;
  std::vector<Vector3> chosen = {points.front()};
  add_spanning_point(points, chosen);
  chosen.erase(chosen.begin());  // the farthest point from an arbitrary one is an extreme point
  for (int k = 0; k < 3; ++k) add_spanning_point(points, chosen);
  ConvexBody result = convex_body(chosen);
  if (result.empty()) return body;
  // A closed triangle mesh with V points has 2 V - 4 faces.
  while (2 * (result.hull.points.size() + 1) - 4 <= static_cast<std::size_t>(faces)) {
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double excess = result.excess(points[i]);
      if (!(excess > most)) continue;
      most = excess;
      best = i;
    }
    if (!(most > 0.0)) break;
    const std::size_t before = result.hull.points.size();
    chosen = result.hull.points;
    chosen.push_back(points[best]);
    result = convex_body(chosen);
    if (result.hull.points.size() == before) break;  // within rounding, the point lies in a face
  }
  return result;
}

}  // namespace wscvt
