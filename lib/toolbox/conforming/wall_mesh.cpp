// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/wall_mesh.h"

#include <algorithm>
#include <utility>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

bool has(const WallVertices& list, std::int32_t v) {
  return std::find(list.begin(), list.end(), v) != list.end();
}

bool same_wall(const WallTriangle& a, const WallTriangle& b) {
  return a.inner == b.inner && a.outer == b.outer;
}

/// Four times the area over the sum of the squared edges, scaled: 1 for even edges, 0 for a flat
/// triangle.
double evenness(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  constexpr double twice_root_3 = 3.4641016151377544;
  return squares > 0.0 ? twice_root_3 * doubled_area_normal(a, b, c).norm() / squares : 0.0;
}

}  // namespace

WallMesh::WallMesh(const DenseWalls& dense)
    : WallComplex(dense.walls()), places(dense.places()), dense_(dense) {
  anchors.resize(points.size());
  for (std::size_t v = 0; v < anchors.size(); ++v) anchors[v] = static_cast<std::int32_t>(v);
  link();
}

void WallMesh::link() {
  first_.assign(points.size(), -1);
  next_.assign(3 * triangles.size(), -1);
  for (std::size_t t = triangles.size(); t-- > 0;) {
    for (std::size_t k = 0; k < 3; ++k) enter(t, k);
  }
}

void WallMesh::enter(std::size_t t, std::size_t k) {
  const std::size_t v = index(triangles[t].corners[k]);
  next_[3 * t + k] = first_[v];
  first_[v] = static_cast<std::int32_t>(3 * t + k);
}

void WallMesh::remove(std::size_t t, std::size_t k) {
  const auto c = static_cast<std::int32_t>(3 * t + k);
  std::int32_t* place = &first_[triangles[t].corners[k]];
  while (*place != c) place = &next_[*place];
  *place = next_[c];
}

void WallMesh::kill(std::size_t t) {
  for (std::size_t k = 0; k < 3; ++k) remove(t, k);
  triangles[t].corners = {-1, -1, -1};
}

std::size_t WallMesh::corner(std::size_t t, std::int32_t v) const {
  const Triangle& c = triangles[t].corners;
  return c[0] == v ? 0 : c[1] == v ? 1 : c[2] == v ? 2 : 3;
}

EdgeTriangles WallMesh::triangles_at(std::int32_t a, std::int32_t b) const {
  EdgeTriangles list;
  visit_triangles(a, [&](std::size_t t) {
    if (corner(t, b) < 3) list.push_back(t);
  });
  return list;
}

bool WallMesh::is_line(const EdgeTriangles& at_edge) const {
  return at_edge.size() != 2 || !same_wall(triangles[at_edge[0]], triangles[at_edge[1]]);
}

bool WallMesh::is_alone(std::size_t t) const {
  const auto& [a, b, c] = triangles[t].corners;
  return is_alive(t) && triangles[t].outer >= 0 && is_line(triangles_at(a, b)) &&
         is_line(triangles_at(b, c)) && is_line(triangles_at(c, a));
}

WallVertices WallMesh::line_neighbours(std::int32_t v) const {
  WallVertices seen;
  WallVertices found;
  visit_triangles(v, [&](std::size_t t) {
    for (const std::int32_t other : triangles[t].corners) {
      if (other == v || places[other] == WallPlace::Wall || has(seen, other)) continue;
      seen.push_back(other);
      if (is_line(triangles_at(v, other))) found.push_back(other);
    }
  });
  return found;
}

bool WallMesh::keeps_links(std::int32_t gone, std::int32_t kept,
                           const EdgeTriangles& at_edge) const {
  WallVertices opposite;
  for (const std::size_t t : at_edge) {
    for (const std::int32_t v : triangles[t].corners) {
      if (v == gone || v == kept) continue;
      if (has(opposite, v)) return false;
      opposite.push_back(v);
    }
  }
  WallVertices about;
  visit_triangles(gone, [&](std::size_t t) {
    for (const std::int32_t v : triangles[t].corners) {
      if (v != gone && !has(about, v)) about.push_back(v);
    }
  });
  bool keeps = true;
  visit_triangles(kept, [&](std::size_t t) {
    const Triangle& c = triangles[t].corners;
    if (corner(t, gone) < 3) return;
    int among_opposite = 0;
    for (const std::int32_t v : c) {
      if (v == kept) continue;
      const bool is_opposite = has(opposite, v);
      if (has(about, v) && !is_opposite) keeps = false;
      among_opposite += is_opposite ? 1 : 0;
    }
    if (among_opposite < 2) return;
    // Both triangles over this edge would become one.
    const std::size_t k = corner(t, kept);
    const std::int32_t a = c[following(k)];
    for (const std::size_t other : triangles_at(gone, a)) {
      if (corner(other, c[preceding(k)]) < 3) keeps = false;
    }
  });
  return keeps;
}

bool WallMesh::keeps_bodies(std::int32_t gone, std::int32_t kept,
                            const EdgeTriangles& at_edge) const {
  WallVertices at_gone;
  WallVertices at_both;
  const auto add = [](WallVertices& list, std::int32_t body) {
    if (!has(list, body)) list.push_back(body);
  };
  for (const std::size_t t : at_edge) {
    add(at_both, triangles[t].inner);
    add(at_both, triangles[t].outer);
  }
  visit_triangles(gone, [&](std::size_t t) {
    add(at_gone, triangles[t].inner);
    add(at_gone, triangles[t].outer);
  });
  bool keeps = true;
  visit_triangles(kept, [&](std::size_t t) {
    for (const std::int32_t body : {triangles[t].inner, triangles[t].outer}) {
      if (has(at_gone, body) && !has(at_both, body)) keeps = false;
    }
  });
  return keeps;
}

double WallMesh::agreement(const Triangle& corners, const Vector3& normal) const {
  constexpr double unknown = 2.0;
  double least = unknown;
  const double length = normal.norm();
  for (const std::int32_t v : corners) {
    if (places[v] != WallPlace::Wall || anchors[v] < 0) continue;
    const Vector3 outward = dense_.normals()[anchors[v]].cast<double>();
    least = std::min(least, length > 0.0 ? normal.dot(outward) / length : -1.0);
  }
  return least;
}

bool WallMesh::may_become(std::size_t t, const Triangle& corners, const std::array<Vector3, 3>& x,
                          double turn, double least) const {
  constexpr double enough = 0.3;
  const Triangle& now = triangles[t].corners;
  const Vector3 before = normal_of(t);
  const Vector3 after = doubled_area_normal(x[0], x[1], x[2]);
  const double shape = evenness(x[0], x[1], x[2]);
  if (shape < least && shape < evenness_of(t)) return false;
  if (!follows_dense) return true;
  const double cosine = agreement(corners, after);
  if (cosine > 1.5) return after.dot(before) > turn * after.norm() * before.norm();
  return cosine > enough || cosine > agreement(now, before);
}

Vector3 WallMesh::normal_of(std::size_t t) const {
  const Triangle& c = triangles[t].corners;
  return doubled_area_normal(points[c[0]], points[c[1]], points[c[2]]);
}

bool WallMesh::is_sliver(std::size_t t) const {
  if (!drops_walls) return false;
  constexpr double flat = 1e-3;  // then the height is as small against the edges
  return evenness_of(t) < flat;
}

double WallMesh::evenness_of(std::size_t t) const {
  const Triangle& c = triangles[t].corners;
  return evenness(points[c[0]], points[c[1]], points[c[2]]);
}

bool WallMesh::keeps_shape(std::int32_t moved, std::int32_t other, std::int32_t into,
                           const Vector3& position, double longest, double least) const {
  bool keeps = true;
  visit_triangles(moved, [&](std::size_t t) {
    if (!keeps || corner(t, other) < 3) return;
    const std::size_t k = corner(t, moved);
    const Triangle& c = triangles[t].corners;
    const Vector3& a = points[c[following(k)]];
    const Vector3& b = points[c[preceding(k)]];
    const double limit = longest * longest;
    if (std::max((a - position).squaredNorm(), (b - position).squaredNorm()) > limit) keeps = false;
    const Vector3 after = doubled_area_normal(position, a, b);
    if (is_sliver(t)) {
      // Its own normal is rounding, that of its wall there is not.
      Vector3 about = Vector3::Zero();
      visit_triangles(moved, [&](std::size_t near) {
        if (same_wall(triangles[near], triangles[t])) about += normal_of(near);
      });
      if (after.dot(about) < 0.0) keeps = false;
      return;
    }
    const Vector3 before = normal_of(t);
    if (!(after.dot(before) > least_cosine * after.norm() * before.norm())) keeps = false;
    Triangle corners = c;
    corners[k] = into;
    std::array<Vector3, 3> x;
    x[k] = position;
    x[following(k)] = a;
    x[preceding(k)] = b;
    if (!may_become(t, corners, x, least_cosine, least)) keeps = false;
  });
  return keeps;
}

bool WallMesh::keeps_lines(std::int32_t gone, std::int32_t kept,
                           const EdgeTriangles& at_edge) const {
  const WallPlace place = places[gone];
  if (place == WallPlace::Wall) return true;
  const bool is_on_line = is_line(at_edge);
  if (!is_on_line && !drops_walls) return false;
  if (!keeps_bodies(gone, kept, at_edge)) return false;
  // Two lines become one where the triangle between them was all that was left of a wall.
  for (const std::int32_t end : line_neighbours(gone)) {
    if (end == kept) continue;
    const EdgeTriangles across = triangles_at(end, kept);
    if (across.empty() || !is_line(across)) continue;
    if (!drops_walls || places[end] != WallPlace::Point) return false;
    // A body all around that wall would touch itself in the line that is left.
    WallVertices sides;
    for (const EdgeTriangles& edge : {triangles_at(end, gone), across}) {
      for (const std::size_t t : edge) {
        if (std::find(at_edge.begin(), at_edge.end(), t) != at_edge.end()) continue;
        for (const std::int32_t body : {triangles[t].inner, triangles[t].outer}) {
          if (body >= 0 && std::count(sides.begin(), sides.end(), body) == 2) return false;
          sides.push_back(body);
        }
      }
    }
  }
  return true;
}

bool WallMesh::collapse(std::int32_t gone, std::int32_t kept, const Vector3& position,
                        double longest, double evenness) {
  if (places[gone] > places[kept]) return false;
  const EdgeTriangles at_edge = triangles_at(gone, kept);
  if (!keeps_lines(gone, kept, at_edge)) return false;
  const bool is_point = places[gone] != WallPlace::Wall && !is_line(at_edge);
  if (!keeps_links(gone, kept, at_edge) ||
      !keeps_shape(gone, kept, kept, position, longest, evenness)) {
    return false;
  }
  if (position != points[kept] && !keeps_shape(kept, gone, kept, position, longest, evenness))
    return false;
  for (const std::size_t t : at_edge) kill(t);
  while (first_[gone] >= 0) {
    const std::size_t c = index(first_[gone]);
    remove(c / 3, c % 3);
    triangles[c / 3].corners[c % 3] = kept;
    enter(c / 3, c % 3);
  }
  points[kept] = position;
  if (is_point) places[kept] = WallPlace::Point;
  return true;
}

std::int32_t WallMesh::split(std::int32_t a, std::int32_t b) {
  const EdgeTriangles at_edge = triangles_at(a, b);
  const bool is_on_line = is_line(at_edge);
  const auto middle = static_cast<std::int32_t>(points.size());
  const WallPlace place = is_on_line ? WallPlace::Line : WallPlace::Wall;
  points.emplace_back(0.5 * (points[a] + points[b]));
  places.push_back(place);
  // A line's node needs an anchor on the line, which points are not; -1: there is none.
  std::int32_t anchor = places[a] == place ? anchors[a] : anchors[b];
  if (is_on_line && places[a] != place && places[b] != place) anchor = -1;
  anchors.push_back(anchor);
  first_.push_back(-1);
  for (const std::size_t t : at_edge) {
    WallTriangle half = triangles[t];
    half.corners[corner(t, a)] = middle;
    const std::size_t k = corner(t, b);
    remove(t, k);
    triangles[t].corners[k] = middle;
    enter(t, k);
    const std::size_t added = triangles.size();
    triangles.push_back(half);
    next_.insert(next_.end(), 3, -1);
    for (std::size_t c = 0; c < 3; ++c) enter(added, c);
  }
  return middle;
}

bool WallMesh::is_flat(std::int32_t a, std::int32_t b) const {
  const EdgeTriangles at_edge = triangles_at(a, b);
  if (is_line(at_edge)) return false;
  const Vector3 first = normal_of(at_edge[0]);
  const Vector3 second = normal_of(at_edge[1]);
  constexpr double rounding = 1e-9;  // of a sine; wide against that of cut points
  return is_sliver(at_edge[0]) || is_sliver(at_edge[1]) ||
         first.cross(second).norm() <= rounding * first.norm() * second.norm();
}

bool WallMesh::flip(std::int32_t a, std::int32_t b) {
  const EdgeTriangles at_edge = triangles_at(a, b);
  if (is_line(at_edge)) return false;
  std::size_t s = at_edge[0];
  std::size_t t = at_edge[1];
  // s = (a, b, c), t = (b, a, d)
  if (triangles[s].corners[following(corner(s, a))] != b) std::swap(s, t);
  const std::int32_t c = triangles[s].corners[following(corner(s, b))];
  const std::int32_t d = triangles[t].corners[following(corner(t, a))];
  const Vector3& pa = points[a];
  const Vector3& pb = points[b];
  const Vector3& pc = points[c];
  const Vector3& pd = points[d];
  const double before = std::min(evenness(pa, pb, pc), evenness(pb, pa, pd));
  const double after = std::min(evenness(pa, pd, pc), evenness(pd, pb, pc));
  if (!(after > before + 1e-6) || c == d || !triangles_at(c, d).empty()) return false;
  const Vector3 old_s = doubled_area_normal(pa, pb, pc);
  const Vector3 old_t = doubled_area_normal(pb, pa, pd);
  const Vector3 new_s = doubled_area_normal(pa, pd, pc);
  const Vector3 new_t = doubled_area_normal(pd, pb, pc);
  const auto cosine = [](const Vector3& x, const Vector3& y) {
    const double lengths = x.norm() * y.norm();
    return lengths > 0.0 ? x.dot(y) / lengths : -1.0;
  };
  // The new edge may bend by 60 degrees, or less than the old one.
  constexpr double sixty_degrees = 0.5;
  if (cosine(new_s, new_t) < std::min(sixty_degrees, cosine(old_s, old_t))) return false;
  const double least = std::min({0.3, agreement({a, b, c}, old_s), agreement({b, a, d}, old_t)});
  if (std::min(agreement({a, d, c}, new_s), agreement({d, b, c}, new_t)) < least) return false;
  const Vector3 mean = old_s + old_t;
  if (!(std::min(cosine(new_s, mean), cosine(new_t, mean)) > sixty_degrees)) return false;
  for (const std::size_t triangle : {s, t}) {
    for (std::size_t k = 0; k < 3; ++k) remove(triangle, k);
  }
  triangles[s].corners = {a, d, c};
  triangles[t].corners = {d, b, c};
  for (const std::size_t triangle : {s, t}) {
    for (std::size_t k = 0; k < 3; ++k) enter(triangle, k);
  }
  return true;
}

void WallMesh::compact() {
  std::vector<std::int32_t> number(points.size(), -1);
  std::size_t kept = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (first_[v] < 0) continue;
    number[v] = static_cast<std::int32_t>(kept);
    points[kept] = points[v];
    places[kept] = places[v];
    anchors[kept] = anchors[v];
    ++kept;
  }
  points.resize(kept);
  places.resize(kept);
  anchors.resize(kept);
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                                 [](const WallTriangle& t) { return t.corners[0] < 0; }),
                  triangles.end());
  for (WallTriangle& t : triangles) {
    for (std::int32_t& corner : t.corners) corner = number[corner];
  }
  link();
}

}  // namespace wscvt
