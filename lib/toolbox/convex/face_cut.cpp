// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/face_cut.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "wscvt/base/error.h"

namespace wscvt {

namespace {

/// Returns the two coordinates in which a face with this normal has the largest projection.
std::array<int, 2> plane_axes(const Vector3& normal) {
  int dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  return {(dropped + 1) % 3, (dropped + 2) % 3};
}

bool loop_holds(const std::vector<Vector3>& points, const FaceEdges& loop, const Vector3& p,
                const std::array<int, 2>& axes) {
  bool inside = false;
  for (const auto& [i, j] : loop) {
    const Vector3& a = points[i];
    const Vector3& b = points[j];
    if ((a[axes[1]] > p[axes[1]]) == (b[axes[1]] > p[axes[1]])) continue;
    const double fraction = (p[axes[1]] - a[axes[1]]) / (b[axes[1]] - a[axes[1]]);
    if (p[axes[0]] < a[axes[0]] + fraction * (b[axes[0]] - a[axes[0]])) inside = !inside;
  }
  return inside;
}

}  // namespace

void require_closed(const std::vector<Triangle>& triangles) {
  std::unordered_map<std::uint64_t, int> sides;
  for (const auto& [a, b, c] : triangles) {
    for (const std::uint64_t key : {edge_key(a, b), edge_key(b, c), edge_key(c, a)}) ++sides[key];
  }
  for (const auto& [key, count] : sides) {
    const auto back = sides.find(key << 32U | key >> 32U);
    if (back != sides.end() && back->second == 1) continue;
    refuse(
        "The mesh is not closed, or an edge has more than two triangles. Repair the mesh first.");
  }
}

Vector3 doubled_area(const std::vector<Vector3>& points, const FaceEdge* first,
                     const FaceEdge* last) {
  const Vector3& origin = points[(*first)[0]];
  Vector3 sum = Vector3::Zero();
  for (const FaceEdge* e = first; e != last; ++e) {
    sum += (points[(*e)[0]] - origin).cross(points[(*e)[1]] - origin);
  }
  return sum;
}

std::vector<FaceEdges> loops_of(const FaceEdges& edges) {
  std::unordered_map<std::int32_t, std::size_t> starting;
  for (std::size_t e = 0; e < edges.size(); ++e) starting[edges[e][0]] = e;
  std::vector<char> used(edges.size(), 0);
  std::vector<FaceEdges> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start] != 0) continue;
    loops.emplace_back();
    for (std::size_t e = start; used[e] == 0; e = starting.at(edges[e][1])) {
      used[e] = 1;
      loops.back().push_back(edges[e]);
    }
  }
  return loops;
}

std::vector<FaceEdges> faces_of(const std::vector<Vector3>& points, const FaceEdges& edges,
                                const Vector3& normal) {
  std::vector<FaceEdges> loops = loops_of(edges);
  if (loops.size() == 1) return {edges};
  std::vector<double> areas;
  areas.reserve(loops.size());
  for (const auto& loop : loops) {
    areas.push_back(doubled_area(points, loop).dot(normal));
  }
  std::vector<FaceEdges> holes(loops.size());
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (!(areas[k] < 0.0)) continue;
    std::size_t outer = loops.size();
    for (std::size_t o = 0; o < loops.size(); ++o) {
      if (!(areas[o] > -areas[k]) || (outer < loops.size() && areas[o] >= areas[outer])) continue;
      if (loop_holds(points, loops[o], points[loops[k].front()[0]], plane_axes(normal))) outer = o;
    }
    // A hole outside all loops is a loop without area, turned by rounding: a normal face.
    if (outer == loops.size()) continue;
    holes[outer].insert(holes[outer].end(), loops[k].begin(), loops[k].end());
    loops[k].clear();
  }
  std::vector<FaceEdges> faces;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (loops[k].empty()) continue;
    loops[k].insert(loops[k].end(), holes[k].begin(), holes[k].end());
    faces.push_back(std::move(loops[k]));
  }
  return faces;
}

std::int32_t FaceCutter::crossing(std::int32_t a, std::int32_t b) {
  if (a > b) std::swap(a, b);
  const auto [found, is_new] =
      crossings_.try_emplace(edge_key(a, b), static_cast<std::int32_t>(points_.size()));
  if (is_new) {
    const double fraction = std::clamp(heights_[a] / (heights_[a] - heights_[b]), 0.0, 1.0);
    const Vector3 point = points_[a] + fraction * (points_[b] - points_[a]);
    points_.push_back(point);
  }
  return found->second;
}

void FaceCutter::divide(const FaceEdge* first, const FaceEdge* last, const Vector3& along,
                        FaceParts& parts) {
  parts.above.clear();
  parts.below.clear();
  parts.down.clear();
  parts.up.clear();
  for (const FaceEdge* e = first; e != last; ++e) {
    const auto& [a, b] = *e;
    if (is_above(a) == is_above(b)) {
      (is_above(a) ? parts.above : parts.below).push_back({a, b});
      continue;
    }
    const std::int32_t x = crossing(a, b);
    (is_above(a) ? parts.above : parts.below).push_back({a, x});
    (is_above(b) ? parts.above : parts.below).push_back({x, b});
    (is_above(a) ? parts.down : parts.up).push_back(x);
  }
  // Along the plane the two kinds of crossings alternate.
  const auto order = [&](std::int32_t a, std::int32_t b) {
    return along.dot(points_[a]) < along.dot(points_[b]);
  };
  if (parts.down.size() > 1) {
    std::stable_sort(parts.down.begin(), parts.down.end(), order);
    std::stable_sort(parts.up.begin(), parts.up.end(), order);
  }
  for (std::size_t k = 0; k < parts.down.size(); ++k) {
    parts.above.push_back({parts.down[k], parts.up[k]});
    parts.below.push_back({parts.up[k], parts.down[k]});
  }
}

}  // namespace wscvt
