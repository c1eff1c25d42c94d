// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/convex_hull.h"

#include <CGAL/Convex_hull_traits_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"

namespace wscvt {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Hull = CGAL::Surface_mesh<Point>;

/// CGAL's traits with progress reports in the test on which side of a face a point lies, because
/// the hull of a million points takes seconds.
struct ReportingHullTraits : CGAL::Convex_hull_traits_3<Kernel, Hull, CGAL::Tag_true> {
  using Base = CGAL::Convex_hull_traits_3<Kernel, Hull, CGAL::Tag_true>;

  // NOLINTNEXTLINE(readability-identifier-naming): the name that CGAL requires
  struct Has_on_positive_side_3 {
    using result_type = bool;

    bool operator()(const Base::Plane_3& plane, const Point& point) const {
      constexpr std::size_t questions_a_report = 1 << 18;  // some hundredths of a second
      if (++*asked % questions_a_report == 0) execution->report(0.0, "Measuring the convex hull");
      return on_positive_side(plane, point);
    }

    Base::Has_on_positive_side_3 on_positive_side;
    const Execution* execution;
    std::size_t* asked;
  };
  Has_on_positive_side_3 has_on_positive_side_3_object() const {
    return {Base::has_on_positive_side_3_object(), execution, asked};
  }

  const Execution* execution;
  std::size_t* asked;  ///< number of tests
};

/// Cuts every plane face of more than three corners into triangles about its first corner. CGAL's
/// triangulation of it depends on addresses, and so do the last digits of sums over the triangles.
/// Flips edges within the plane towards the smaller corner until that corner is joined to all
/// others.
void cut_planes_alike(const std::vector<Point>& points, std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> opposite = link_half_edges(triangles, points.size()).opposite;
  const auto halves = static_cast<std::int32_t>(opposite.size());
  for (bool flips = true; flips;) {
    flips = false;
    for (std::int32_t h = 0; h < halves; ++h) {
      const std::int32_t other = opposite[h];
      const std::int32_t a = origin_of(triangles, h);
      const std::int32_t b = origin_of(triangles, other);
      const std::int32_t c = origin_of(triangles, previous_half_edge(h));
      const std::int32_t d = origin_of(triangles, previous_half_edge(other));
      if (std::min(c, d) >= std::min(a, b) ||
          !CGAL::coplanar(points[a], points[b], points[c], points[d]) ||
          CGAL::coplanar_orientation(points[c], points[d], points[a], points[b]) !=
              CGAL::NEGATIVE) {
        continue;
      }
      flip_edge(h, triangles, opposite);
      flips = true;
    }
  }
}

}  // namespace

std::vector<Triangle> convex_hull_triangles(const std::vector<Vector3>& points,
                                            const Execution& execution) {
  std::vector<Point> input;
  input.reserve(points.size());
  for (const Vector3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  Hull hull;
  std::size_t asked = 0;
  ReportingHullTraits traits;
  traits.execution = &execution;
  traits.asked = &asked;
  CGAL::convex_hull_3(input.begin(), input.end(), hull, traits);
  std::vector<Triangle> triangles;
  // If all points lie in one plane, CGAL returns their polygon, which is not closed.
  if (hull.num_vertices() < 4 || !CGAL::is_closed(hull)) return triangles;

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
  // convex_hull_3 returns only triangles, but its type allows larger faces.
  for (const auto face : hull.faces()) {
    std::vector<std::int32_t> corners;
    for (const auto vertex : hull.vertices_around_face(hull.halfedge(face))) {
      corners.push_back(index_of_hull_vertex[vertex]);
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  cut_planes_alike(input, triangles);
  // CGAL's order of the triangles also depends on addresses.
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

IndexedMesh convex_hull(const std::vector<Vector3>& points, const Execution& execution) {
  IndexedMesh hull{points, convex_hull_triangles(points, execution)};
  if (hull.triangles.empty()) {
    refuse("The points lie in one plane, so their convex hull has no volume. Give a solid body.");
  }
  drop_unused_points(hull);
  return hull;
}

namespace {

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Removes points well inside the polygon of the farthest points in eight directions (Akl and
/// Toussaint 1978): nine of ten points of a body. The hull does not change.
void remove_inner_points(std::vector<Vector2>& points) {
  constexpr std::size_t corners = 8;
  constexpr std::size_t worthwhile = 24;
  if (points.size() < worthwhile) return;
  // Along x, the diagonal, y and the other diagonal, then against them.
  std::array<Vector2, corners> far;
  far.fill(points.front());
  std::array<double, corners> reach;
  reach.fill(-std::numeric_limits<double>::infinity());
  for (const Vector2& p : points) {
    const std::array<double, 4> places = {p.x(), p.x() + p.y(), p.y(), p.y() - p.x()};
    for (std::size_t k = 0; k < 4; ++k) {
      if (places[k] > reach[k]) {
        reach[k] = places[k];
        far[k] = p;
      }
      if (-places[k] > reach[k + 4]) {
        reach[k + 4] = -places[k];
        far[k + 4] = p;
      }
    }
  }
  // Larger than the rounding of the cross products below.
  const double width = std::max(reach[0] + reach[4], reach[2] + reach[6]);
  const double margin = 1e-12 * width * width;
  std::array<Vector2, corners> starts;
  std::array<Vector2, corners> edges;
  std::size_t sides = 0;
  for (std::size_t k = 0; k < corners; ++k) {
    const Vector2& next = far[(k + 1) % corners];
    if (next == far[k]) continue;
    starts[sides] = far[k];
    edges[sides++] = next - far[k];
  }
  const auto is_inner = [&](const Vector2& p) {
    for (std::size_t k = 0; k < sides; ++k) {
      if (!(cross(edges[k], p - starts[k]) > margin)) return false;
    }
    return true;
  };
  points.erase(std::remove_if(points.begin(), points.end(), is_inner), points.end());
}

}  // namespace

std::vector<Vector2> planar_hull(std::vector<Vector2>& points) {
  remove_inner_points(points);
  return planar_hull_of_few(points);
}

std::vector<Vector2> planar_hull_of_few(std::vector<Vector2>& points) {
  std::sort(points.begin(), points.end(), [](const Vector2& a, const Vector2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector2> hull;
  if (points.empty()) return hull;
  hull.reserve(points.size() + 1);
  const auto add = [&hull](const Vector2& p, std::size_t least) {
    while (hull.size() >= least + 2 &&
           !(cross(hull.back() - hull[hull.size() - 2], p - hull.back()) > 0.0)) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Vector2& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p < points.rend(); ++p) add(*p, lower);
  if (hull.size() > 1) hull.pop_back();  // the first again
  return hull;
}

Rectangle smallest_rectangle(const std::vector<Vector2>& hull) {
  const std::size_t n = hull.size();
  Rectangle best;
  if (n < 3) return best;
  double least = std::numeric_limits<double>::infinity();
  // The farthest corners along, across and against a side advance with the side.
  std::size_t right = 1;
  std::size_t top = 1;
  std::size_t left = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2 edge = hull[(i + 1) % n] - hull[i];
    const double squared = edge.squaredNorm();
    if (!(squared > 0.0)) continue;
    const Vector2 across(-edge.y(), edge.x());
    const auto follow = [&](std::size_t& k, const Vector2& direction) {
      while (direction.dot(hull[(k + 1) % n] - hull[k]) > 0.0) k = (k + 1) % n;
    };
    follow(right, edge);
    if (i == 0) top = right;
    follow(top, across);
    if (i == 0) left = top;
    follow(left, -edge);
    // Both are times the length of the edge.
    const double length = edge.dot(hull[right] - hull[left]);
    const double width = across.dot(hull[top] - hull[i]);
    const double area = length * width / squared;
    if (area < least) {
      least = area;
      const double unit = std::sqrt(squared);
      best.side = edge / unit;
      best.length = length / unit;
      best.width = width / unit;
    }
  }
  return best;
}

FarthestPair farthest_pair(const std::vector<Vector2>& hull) {
  FarthestPair best;
  if (hull.empty()) return best;
  best.from = best.to = hull.front();
  double square = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double tried = (hull[i] - hull[k]).squaredNorm();
      if (!(tried > square)) continue;
      square = tried;
      best.from = hull[k];
      best.to = hull[i];
    }
  }
  best.distance = std::sqrt(square);
  return best;
}

}  // namespace wscvt
