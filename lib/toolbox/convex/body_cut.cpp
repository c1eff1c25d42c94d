// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/body_cut.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

using SolidEdge = CutSolid::Edge;

std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32U) |
         static_cast<std::uint32_t>(b);
}

/// Returns twice the area of closed loops, along their normal.
Vector3 doubled_area(const std::vector<Vector3>& points, const SolidEdge* first,
                     const SolidEdge* last) {
  const Vector3& origin = points[(*first)[0]];
  Vector3 sum = Vector3::Zero();
  for (const SolidEdge* e = first; e != last; ++e) {
    sum += (points[(*e)[0]] - origin).cross(points[(*e)[1]] - origin);
  }
  return sum;
}

/// Returns the two coordinates in which a face with this normal has the largest projection.
std::array<int, 2> plane_axes(const Vector3& normal) {
  int dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  return {(dropped + 1) % 3, (dropped + 2) % 3};
}

bool loop_holds(const std::vector<Vector3>& points, const std::vector<SolidEdge>& loop,
                const Vector3& p, const std::array<int, 2>& axes) {
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

/// Returns closed loops of directed edges, in the order of their first edges.
std::vector<std::vector<SolidEdge>> loops_of(const std::vector<SolidEdge>& edges) {
  std::unordered_map<std::int32_t, std::size_t> starting;
  for (std::size_t e = 0; e < edges.size(); ++e) starting[edges[e][0]] = e;
  std::vector<char> used(edges.size(), 0);
  std::vector<std::vector<SolidEdge>> loops;
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

}  // namespace

/// One side of a plane, with numbers of the old points, then of the crossings.
struct CutSolid::Side {
  std::vector<Edge> edges;
  std::vector<Face> faces;
  std::vector<Edge> face;  ///< edges of the current face
  std::vector<Edge> cap;   ///< edges of the new face in the plane

  /// Adds a face of one loop, or of an outer loop and holes.
  void add_face(const std::vector<Edge>& of_face, const Vector3& normal, bool is_cap) {
    const std::size_t first = edges.size();
    edges.insert(edges.end(), of_face.begin(), of_face.end());
    faces.push_back({normal, first, edges.size(), is_cap});
  }

  /// Adds a plane's faces from their edges: each outer loop is a face, with the holes in it.
  void add_caps(const std::vector<Vector3>& points, const std::vector<Edge>& of_caps,
                const Vector3& normal) {
    std::vector<std::vector<Edge>> loops = loops_of(of_caps);
    if (loops.size() == 1) return add_face(of_caps, normal, true);
    std::vector<double> areas;
    areas.reserve(loops.size());
    for (const auto& loop : loops) {
      areas.push_back(doubled_area(points, loop.data(), loop.data() + loop.size()).dot(normal));
    }
    std::vector<std::vector<Edge>> holes(loops.size());
    for (std::size_t k = 0; k < loops.size(); ++k) {
      if (!(areas[k] < 0.0)) continue;
      std::size_t outer = loops.size();
      for (std::size_t o = 0; o < loops.size(); ++o) {
        if (!(areas[o] > -areas[k]) || (outer < loops.size() && areas[o] >= areas[outer])) continue;
        if (loop_holds(points, loops[o], points[loops[k].front()[0]], plane_axes(normal)))
          outer = o;
      }
      // A hole outside all loops is a loop without area, turned by rounding: a normal face.
      if (outer == loops.size()) continue;
      holes[outer].insert(holes[outer].end(), loops[k].begin(), loops[k].end());
      loops[k].clear();
    }
    for (std::size_t k = 0; k < loops.size(); ++k) {
      if (loops[k].empty()) continue;
      loops[k].insert(loops[k].end(), holes[k].begin(), holes[k].end());
      add_face(loops[k], normal, true);
    }
  }
};

CutSolid::CutSolid(const IndexedMesh& mesh) : points_(mesh.points) {
  std::unordered_map<std::uint64_t, int> sides;
  for (const Triangle& t : mesh.triangles) {
    const Vector3 normal =
        doubled_area_normal(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    const std::size_t first = edges_.size();
    for (std::size_t k = 0; k < 3; ++k) {
      edges_.push_back({t[k], t[(k + 1) % 3]});
      ++sides[edge_key(t[k], t[(k + 1) % 3])];
    }
    faces_.push_back({normal.normalized(), first, edges_.size(), false});
  }
  for (const auto& [a, b] : edges_) {
    const auto back = sides.find(edge_key(b, a));
    if (back == sides.end() || back->second != 1) {
      refuse(
          "The mesh is not closed, or an edge has more than two triangles. Repair the mesh first.");
    }
  }
  volume_ = volume_of(mesh, Execution(1));
}

void CutSolid::append_pieces(const std::vector<Vector3>& points, const Side& side,
                             double least_volume, std::vector<CutSolid>& pieces) {
  std::vector<std::int32_t> parent(points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Face& face : side.faces) {
    const std::int32_t start = side.edges[face.first][0];
    for (std::size_t e = face.first; e < face.last; ++e) {
      // A face with holes connects the parts around it.
      parent[root(side.edges[e][0])] = root(face.is_cap ? start : side.edges[e][1]);
    }
  }
  std::vector<std::int32_t> piece_of(points.size(), -1);
  std::vector<std::int32_t> number(points.size(), -1);
  std::vector<CutSolid> found;
  for (const Face& face : side.faces) {
    std::int32_t& piece = piece_of[root(side.edges[face.first][0])];
    if (piece < 0) {
      piece = static_cast<std::int32_t>(found.size());
      found.push_back(CutSolid());
    }
    CutSolid& solid = found[static_cast<std::size_t>(piece)];
    const std::size_t first = solid.edges_.size();
    for (std::size_t e = face.first; e < face.last; ++e) {
      Edge edge = side.edges[e];
      for (std::int32_t& v : edge) {
        if (number[v] < 0) {
          number[v] = static_cast<std::int32_t>(solid.points_.size());
          solid.points_.push_back(points[v]);
        }
        v = number[v];
      }
      solid.edges_.push_back(edge);
    }
    solid.faces_.push_back({face.normal, first, solid.edges_.size(), face.is_cap});
  }
  for (CutSolid& solid : found) {
    const Vector3 origin = solid.points_.front();
    for (const Face& face : solid.faces_) {
      const Edge* edges = solid.edges_.data();
      solid.volume_ +=
          (solid.points_[edges[face.first][0]] - origin)
              .dot(doubled_area(solid.points_, edges + face.first, edges + face.last)) /
          6.0;
    }
    if (solid.volume_ > least_volume) pieces.push_back(std::move(solid));
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const CutSolid& a, const CutSolid& b) { return a.volume_ > b.volume_; });
}

SolidCut CutSolid::cut(const CutPlane& plane, double on_plane) const {
  std::vector<Vector3> points = points_;
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const Vector3& p : points) heights.push_back(plane.normal.dot(p) - plane.offset);
  const auto is_above = [&](std::int32_t v) { return heights[v] > on_plane; };

  std::unordered_map<std::uint64_t, std::int32_t> crossings;
  const auto crossing = [&](std::int32_t a, std::int32_t b) {
    if (a > b) std::swap(a, b);
    const auto [found, is_new] =
        crossings.try_emplace(edge_key(a, b), static_cast<std::int32_t>(points.size()));
    if (is_new) {
      const double fraction = std::clamp(heights[a] / (heights[a] - heights[b]), 0.0, 1.0);
      const Vector3 point = points[a] + fraction * (points[b] - points[a]);
      points.push_back(point);
    }
    return found->second;
  };

  Side above;
  Side below;
  std::vector<std::int32_t> down;  // points at which a face's edges go below
  std::vector<std::int32_t> up;
  for (const Face& face : faces_) {
    above.face.clear();
    below.face.clear();
    down.clear();
    up.clear();
    for (std::size_t e = face.first; e < face.last; ++e) {
      const auto& [a, b] = edges_[e];
      if (is_above(a) == is_above(b)) {
        (is_above(a) ? above : below).face.push_back({a, b});
        continue;
      }
      const std::int32_t x = crossing(a, b);
      (is_above(a) ? above : below).face.push_back({a, x});
      (is_above(b) ? above : below).face.push_back({x, b});
      (is_above(a) ? down : up).push_back(x);
    }
    // Along the plane the two kinds of crossings alternate.
    const Vector3 along = face.normal.cross(plane.normal);
    const auto order = [&](std::int32_t a, std::int32_t b) {
      return along.dot(points[a]) < along.dot(points[b]);
    };
    if (down.size() > 1) {
      std::stable_sort(down.begin(), down.end(), order);
      std::stable_sort(up.begin(), up.end(), order);
    }
    for (std::size_t k = 0; k < down.size(); ++k) {
      above.face.push_back({down[k], up[k]});
      below.face.push_back({up[k], down[k]});
      above.cap.push_back({up[k], down[k]});
      below.cap.push_back({down[k], up[k]});
    }
    for (Side* side : {&above, &below}) {
      if (side->face.empty()) continue;
      if (face.is_cap && !down.empty()) {
        side->add_caps(points, side->face, face.normal);
      } else {
        side->add_face(side->face, face.normal, face.is_cap);
      }
    }
  }
  SolidCut result;
  if (above.faces.empty() || below.faces.empty()) return result;
  above.add_caps(points, above.cap, -plane.normal);
  below.add_caps(points, below.cap, plane.normal);
  const double least_volume = 1e-12 * volume_;
  append_pieces(points, above, least_volume, result.above);
  append_pieces(points, below, least_volume, result.below);
  return result;
}

std::vector<CutSolid::ReflexEdge> CutSolid::reflex_edges() const {
  std::unordered_map<std::uint64_t, std::size_t> face_of;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (std::size_t e = faces_[f].first; e < faces_[f].last; ++e) {
      face_of[edge_key(edges_[e][0], edges_[e][1])] = f;
    }
  }
  std::vector<ReflexEdge> reflexes;
  for (const Face& face : faces_) {
    for (std::size_t e = face.first; e < face.last; ++e) {
      const auto& [a, b] = edges_[e];
      if (a > b) continue;
      const Vector3& other = faces_[face_of.at(edge_key(b, a))].normal;
      if (face.normal.cross(other).dot(points_[b] - points_[a]) < 0.0) {
        reflexes.push_back({edges_[e], face.normal, other});
      }
    }
  }
  return reflexes;
}

}  // namespace wscvt
