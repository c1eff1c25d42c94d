// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/convex/cut_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "wscvt/base/pi.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

double hull_distance(const IndexedMesh& hull, const SignedGrid& grid) {
  constexpr int most_steps = 16;
  const double step = 2.0 * grid.spacing();
  double most = 0.0;
  for (const auto& [a, b, c] : hull.triangles) {
    const Vector3& p = hull.points[a];
    const Vector3 u = hull.points[b] - p;
    const Vector3 v = hull.points[c] - p;
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    // A face as small as the grid's cells lies on the surface, or nearly so.
    const int steps = std::min(most_steps, static_cast<int>(std::ceil(longest / step)));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vector3 point = p + (i * u + j * v) / std::max(steps, 1);
        most = grid.distance_beyond(most, point);
      }
    }
  }
  return most;
}

double hull_cost(double distance, double excess_volume) {
  constexpr double weight = 0.3;
  return distance + weight * std::cbrt(3.0 * std::max(excess_volume, 0.0) / (4.0 * pi));
}

ConvexPiece convex_piece(ExactSolid solid, const SignedGrid& grid) {
  const IndexedMesh& mesh = solid.mesh();
  ConvexBody body = convex_body(mesh.points);
  const double volume =
      mesh_sums(mesh.points, mesh.triangles, mesh.points.front(), Execution(1)).volume();
  const double distance = hull_distance(body.hull, grid);
  return {std::move(solid), std::move(body), volume, distance};
}

namespace {

using Edge = std::array<std::int32_t, 2>;

/// Edges with the corners opposite to them in their two triangles.
struct EdgeSides {
  Edge edge;
  Edge opposite;
};

std::vector<EdgeSides> edges_of(const IndexedMesh& mesh) {
  std::map<Edge, std::int32_t> open;
  std::vector<EdgeSides> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k];
      const std::int32_t b = t[(k + 1) % 3];
      const std::int32_t c = t[(k + 2) % 3];
      const auto found = open.find({b, a});
      if (found == open.end()) {
        open[{a, b}] = c;
      } else {
        edges.push_back({{b, a}, {found->second, c}});
        open.erase(found);
      }
    }
  }
  return edges;
}

/// The hulls of what lies on one side of a plane, connected by the surface, and what they cost.
struct SideHulls {
  double distance = 0.0;
  double volume = 0.0;
};

class CutScore {
 public:
  CutScore(const ConvexPiece& piece, const std::vector<EdgeSides>& edges, const SignedGrid& grid)
      : piece_(piece), edges_(edges), grid_(grid) {}

  /// Infinite where the plane misses the piece. Without distances it takes less time.
  double operator()(const CutPlane& plane, bool with_distances) const {
    const std::vector<Vector3>& points = piece_.solid.mesh().points;
    std::vector<double> heights;
    heights.reserve(points.size());
    for (const Vector3& p : points) heights.push_back(plane.normal.dot(p) - plane.offset);
    double square = 0.0;
    double volume = 0.0;
    for (int side = 0; side < 2; ++side) {
      const SideHulls hulls = side_hulls(heights, with_distances);
      if (!(hulls.volume > 0.0)) return std::numeric_limits<double>::infinity();
      square += hulls.distance * hulls.distance;
      volume += hulls.volume;
      for (double& height : heights) height = -height;
    }
    return hull_cost(std::sqrt(square), volume - piece_.volume);
  }

 private:
  /// Of the points with a height above 0. A solid whose surface falls into two, as a tube's does,
  /// is taken for two pieces, which costs too much and harms nothing.
  SideHulls side_hulls(const std::vector<double>& heights, bool with_distances) const {
    const std::vector<Vector3>& points = piece_.solid.mesh().points;
    const double on_plane = 1e-9 * grid_.spacing();
    std::vector<std::int32_t> parent(points.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t v) {
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (const EdgeSides& sides : edges_) {
      const auto& [a, b] = sides.edge;
      if (heights[a] > on_plane && heights[b] > on_plane) parent[root(a)] = root(b);
    }
    std::map<std::int32_t, std::vector<Vector3>> parts;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (heights[v] > on_plane) parts[root(static_cast<std::int32_t>(v))].push_back(points[v]);
    }
    for (const EdgeSides& sides : edges_) {
      auto [a, b] = sides.edge;
      if (heights[a] <= on_plane) std::swap(a, b);
      if (heights[a] <= on_plane || heights[b] > on_plane) continue;
      const double share = std::min(1.0, heights[a] / (heights[a] - heights[b]));
      parts[root(a)].emplace_back(points[a] + share * (points[b] - points[a]));
    }
    SideHulls hulls;
    for (const auto& [start, part] : parts) {
      const ConvexBody body = convex_body(part);
      if (body.empty()) continue;
      hulls.volume += body.volume;
      if (!with_distances) continue;
      hulls.distance = std::max(hulls.distance, hull_distance(body.hull, grid_));
    }
    return hulls;
  }

  const ConvexPiece& piece_;
  const std::vector<EdgeSides>& edges_;
  const SignedGrid& grid_;
};

void add_plane(const Vector3& normal, const Vector3& point, std::vector<CutPlane>& planes) {
  if (normal.norm() > 0.0) planes.push_back({normal.normalized(), normal.normalized().dot(point)});
}

void add_slices(const ConvexPiece& piece, const Eigen::Matrix3d& axes,
                std::vector<CutPlane>& planes) {
  constexpr int slices = 12;
  for (int axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vector3& p : piece.body.hull.points) {
      low = std::min(low, axes.col(axis).dot(p));
      high = std::max(high, axes.col(axis).dot(p));
    }
    for (int k = 1; k < slices; ++k) {
      planes.push_back({axes.col(axis), low + (high - low) * k / slices});
    }
  }
}

/// Planes in many directions through the deepest points below the hull, which lie apart.
void add_dent_cuts(const ConvexPiece& piece, const Eigen::Matrix3d& axes,
                   std::vector<CutPlane>& planes) {
  constexpr int dents = 3;
  const std::vector<Vector3>& points = piece.solid.mesh().points;
  std::vector<double> depths;
  depths.reserve(points.size());
  for (const Vector3& p : points) depths.push_back(-piece.body.excess(p));
  const double apart = 0.5 * std::cbrt(piece.volume);
  std::vector<Vector3> chosen;
  while (static_cast<int>(chosen.size()) < dents) {
    std::size_t deepest = 0;
    double most = 0.0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      const bool is_near = std::any_of(chosen.begin(), chosen.end(), [&](const Vector3& other) {
        return (points[v] - other).norm() < apart;
      });
      if (is_near || !(depths[v] > most)) continue;
      most = depths[v];
      deepest = v;
    }
    if (!(most > 0.0)) return;
    chosen.push_back(points[deepest]);
    // Half of the 26 directions of a cube's faces, edges and corners.
    for (int k = 14; k < 27; ++k) {
      add_plane(axes * Vector3(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1), points[deepest], planes);
    }
  }
}

/// Planes along the edges at which the body bends inward most, far below the hull: those of the two
/// faces, and the one between.
void add_edge_cuts(const ConvexPiece& piece, const std::vector<EdgeSides>& edges,
                   std::vector<CutPlane>& planes) {
  constexpr std::size_t most_edges = 8;
  const std::vector<Vector3>& p = piece.solid.mesh().points;
  struct Reflex {
    double weight;
    std::size_t edge;
  };
  std::vector<Reflex> reflexes;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto& [a, b] = edges[e].edge;
    const auto& [c, d] = edges[e].opposite;
    const Vector3 first = doubled_area_normal(p[a], p[b], p[c]).normalized();
    const Vector3 second = doubled_area_normal(p[b], p[a], p[d]).normalized();
    // Some degrees: less is a curved surface, whose dents have planes of their own.
    const double sine = first.cross(second).norm();
    if (first.dot(p[d] - p[a]) <= 0.0 || !(sine > 0.15)) continue;
    const double depth = std::max(0.0, -piece.body.excess(0.5 * (p[a] + p[b])));
    reflexes.push_back({(p[b] - p[a]).norm() * sine * (depth + 1e-9), e});
  }
  std::stable_sort(reflexes.begin(), reflexes.end(),
                   [](const Reflex& one, const Reflex& two) { return one.weight > two.weight; });
  for (std::size_t k = 0; k < std::min(most_edges, reflexes.size()); ++k) {
    const EdgeSides& sides = edges[reflexes[k].edge];
    const Vector3& a = p[sides.edge[0]];
    const Vector3 first = doubled_area_normal(a, p[sides.edge[1]], p[sides.opposite[0]]);
    const Vector3 second = doubled_area_normal(p[sides.edge[1]], a, p[sides.opposite[1]]);
    add_plane(first, a, planes);
    add_plane(second, a, planes);
    add_plane(first.normalized() - second.normalized(), a, planes);
  }
}

/// The first planes, as many as are wanted, the lowest score first; those without a finite one go.
template <class Score>
std::vector<CutPlane> sorted_by(const std::vector<CutPlane>& planes, std::size_t wanted,
                                const Execution& execution, const Score& score) {
  std::vector<double> scores(std::min(wanted, planes.size()));
  execution.parallel_for(scores.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) scores[i] = score(planes[i]);
  });
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a] < scores[b]; });
  std::vector<CutPlane> best;
  for (const std::size_t i : order) {
    if (std::isfinite(scores[i])) best.push_back(planes[i]);
  }
  return best;
}

}  // namespace

std::vector<CutPlane> best_cuts(const ConvexPiece& piece, const Eigen::Matrix3d& axes,
                                const SignedGrid& grid, const Execution& execution) {
  const std::vector<EdgeSides> edges = edges_of(piece.solid.mesh());
  std::vector<CutPlane> planes;
  add_edge_cuts(piece, edges, planes);
  add_slices(piece, axes, planes);
  add_dent_cuts(piece, axes, planes);
  const CutScore score(piece, edges, grid);
  // Those that leave the least volume too much, and of them those that come nearest.
  constexpr std::size_t measured = 24;
  planes = sorted_by(planes, planes.size(), execution,
                     [&](const CutPlane& plane) { return score(plane, false); });
  return sorted_by(planes, measured, execution,
                   [&](const CutPlane& plane) { return score(plane, true); });
}

}  // namespace wscvt
