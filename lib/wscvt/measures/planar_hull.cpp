// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/planar_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace wscvt {

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
