// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "toolbox/fragment/cell_complex.h"

namespace wscvt {

namespace {

using Vector2 = Eigen::Vector2d;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A corner of a loop, by its point. A point may have several corners.
struct Corner {
  std::int32_t point = 0;
  Vector2 place = Vector2::Zero();  ///< in the face's plane
};
using Loop = std::vector<Corner>;

/// Whether the segment from a to b crosses an edge of the loop away from their points.
bool crosses(const Corner& a, const Corner& b, const Loop& loop) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Corner& c = loop[k];
    const Corner& d = loop[(k + 1) % loop.size()];
    if (c.point == a.point || d.point == a.point || c.point == b.point || d.point == b.point) {
      continue;
    }
    const Vector2 along = b.place - a.place;
    const Vector2 edge = d.place - c.place;
    const bool parts =
        (cross(along, c.place - a.place) > 0.0) != (cross(along, d.place - a.place) > 0.0);
    const bool is_parted =
        (cross(edge, a.place - c.place) > 0.0) != (cross(edge, b.place - c.place) > 0.0);
    if (parts && is_parted) return true;
  }
  return false;
}

/// Connects a hole with the loop by an edge there and back, the shortest that crosses nothing.
void add_hole(const std::vector<Loop>& holes, std::size_t number, Loop& loop) {
  const Loop& hole = holes[number];
  struct Bridge {
    double length;
    std::size_t from;
    std::size_t to;
  };
  std::vector<Bridge> bridges;
  for (std::size_t h = 0; h < hole.size(); ++h) {
    for (std::size_t o = 0; o < loop.size(); ++o) {
      bridges.push_back({(loop[o].place - hole[h].place).squaredNorm(), h, o});
    }
  }
  std::stable_sort(bridges.begin(), bridges.end(),
                   [](const Bridge& a, const Bridge& b) { return a.length < b.length; });
  const auto is_free = [&](const Bridge& bridge) {
    const Corner& a = hole[bridge.from];
    const Corner& b = loop[bridge.to];
    return !crosses(a, b, loop) &&
           std::none_of(holes.begin() + static_cast<std::ptrdiff_t>(number), holes.end(),
                        [&](const Loop& other) { return crosses(a, b, other); });
  };
  auto bridge = std::find_if(bridges.begin(), bridges.end(), is_free);
  if (bridge == bridges.end()) bridge = bridges.begin();
  Loop inserted;
  for (std::size_t k = 0; k <= hole.size(); ++k) {
    inserted.push_back(hole[(bridge->from + k) % hole.size()]);
  }
  inserted.push_back(loop[bridge->to]);
  loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(bridge->to) + 1, inserted.begin(),
              inserted.end());
}

/// Cuts the corners off a loop until nothing is left.
class Ears {
 public:
  Ears(Loop loop, std::unordered_set<std::uint64_t>& taken)
      : loop_(std::move(loop)), taken_(taken) {
    for (std::size_t k = 0; k < loop_.size(); ++k) qualities_.push_back(quality(k));
  }

  std::vector<Triangle> cut() {
    std::vector<Triangle> triangles;
    while (loop_.size() >= 3) {
      const std::size_t k = loop_.size() == 3 ? 1 : best();
      const std::int32_t from = at(k + loop_.size() - 1).point;
      const std::int32_t to = at(k + 1).point;
      triangles.push_back({from, loop_[k].point, to});
      taken_.insert(undirected_key(from, to));
      loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(k));
      qualities_.erase(qualities_.begin() + static_cast<std::ptrdiff_t>(k));
      const std::size_t next = k % loop_.size();
      qualities_[next] = quality(next);
      const std::size_t before = (k + loop_.size() - 1) % loop_.size();
      qualities_[before] = quality(before);
    }
    return triangles;
  }

 private:
  const Corner& at(std::size_t k) const { return loop_[k % loop_.size()]; }

  /// Doubled area of the corner's triangle over its longest squared edge; negative: bent inward.
  double quality(std::size_t k) const {
    const Vector2& a = at(k + loop_.size() - 1).place;
    const Vector2& b = loop_[k].place;
    const Vector2& c = at(k + 1).place;
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return longest > 0.0 ? cross(b - a, c - a) / longest : 0.0;
  }

  bool is_new(std::size_t k) const {
    return taken_.count(undirected_key(at(k + loop_.size() - 1).point, at(k + 1).point)) == 0;
  }

  bool is_free(std::size_t k) const {
    const Corner& a = at(k + loop_.size() - 1);
    const Corner& b = loop_[k];
    const Corner& c = at(k + 1);
    const std::array<const Corner*, 3> corners = {&a, &b, &c};
    // A corner on the new edge would leave a triangle without area.
    const double within = -1e-9 * (c.place - a.place).squaredNorm();
    for (const Corner& p : loop_) {
      if (p.point == a.point || p.point == b.point || p.point == c.point) continue;
      bool is_inside = true;
      for (std::size_t e = 0; e < 3 && is_inside; ++e) {
        const Vector2& from = corners[e]->place;
        is_inside = cross(corners[(e + 1) % 3]->place - from, p.place - from) >= within;
      }
      if (is_inside) return false;
    }
    return true;
  }

  /// Returns the best corner whose triangle holds no other corner. If rounding leaves none, the
  /// best whose edge is new: the result is then still closed.
  std::size_t best() const {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < loop_.size(); ++k) {
      if (is_new(k)) order.push_back(k);
    }
    const auto is_better = [&](std::size_t a, std::size_t b) {
      return qualities_[a] != qualities_[b] ? qualities_[a] > qualities_[b] : a < b;
    };
    for (auto top = order.begin(); top != order.end(); ++top) {
      std::iter_swap(top, std::min_element(top, order.end(), is_better));
      if (!(qualities_[*top] > 0.0)) break;
      if (is_free(*top)) return *top;
    }
    return order.empty() ? 1 : order.front();
  }

  Loop loop_;
  std::unordered_set<std::uint64_t>& taken_;
  std::vector<double> qualities_;
};

}  // namespace

std::vector<Triangle> face_triangles(const std::vector<Vector3>& points, const FaceEdges& edges,
                                     const Vector3& normal,
                                     std::unordered_set<std::uint64_t>& taken) {
  if (edges.size() == 3) {
    const bool is_next = edges[1][0] == edges[0][1];
    return {{edges[0][0], edges[0][1], edges[1][is_next ? 1 : 0]}};
  }
  const Vector3 first = normal.isZero() ? Vector3::UnitX() : Vector3(normal.unitOrthogonal());
  const Vector3 second = normal.isZero() ? Vector3::UnitY() : Vector3(normal.cross(first));
  const Vector3& origin = points[edges.front()[0]];
  std::vector<Loop> loops;
  for (const FaceEdges& edge_loop : loops_of(edges)) {
    loops.emplace_back();
    for (const auto& [a, b] : edge_loop) {
      const Vector3 from = points[a] - origin;
      loops.back().push_back({a, {from.dot(first), from.dot(second)}});
    }
  }
  Loop loop = std::move(loops.front());
  loops.erase(loops.begin());
  for (std::size_t k = 0; k < loops.size(); ++k) add_hole(loops, k, loop);
  return Ears(std::move(loop), taken).cut();
}

}  // namespace wscvt
