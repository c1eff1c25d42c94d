// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/cut_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "wscvt/base/portable_math.h"

namespace wscvt {

HullCost::HullCost(const SignedGrid& grid, double tolerance)
    : grid_(&grid), tolerance_(tolerance) {}

double HullCost::distance(const ConvexBody& body) const {
  constexpr int most_steps = 16;
  const IndexedMesh& hull = body.hull;
  const double step = 2.0 * grid_->spacing();
  double most = 0.0;
  Vector3 farthest = hull.points.front();
  for (const auto& [a, b, c] : hull.triangles) {
    const Vector3& p = hull.points[a];
    const Vector3 u = hull.points[b] - p;
    const Vector3 v = hull.points[c] - p;
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    // A face as small as the grid's cells is on the surface, or almost.
    const int steps = std::min(most_steps, static_cast<int>(std::ceil(longest / step)));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vector3 point = p + (i * u + j * v) / std::max(steps, 1);
        const double distance = grid_->at(point);
        if (!(distance > most)) continue;
        most = distance;
        farthest = point;
      }
    }
  }
  return grid_->distance_outside(farthest);
}

double HullCost::operator()(const ConvexBody& body, double volume) const {
  const double excess = std::max(0.0, body.volume - volume);
  return excess * std::sqrt(std::max(distance(body), tolerance_));
}

namespace {

/// Returns the sum of the costs of the hulls of a cut's pieces. Without distances, a cost is the
/// hull's volume less the pieces'. Infinite if the plane misses the piece.
double cut_cost(const CutSolid& solid, const CutPlane& plane, const HullCost& hull_cost,
                bool with_distances) {
  const SolidCut cut = solid.cut(plane, hull_cost.on_plane());
  if (cut.above.empty() || cut.below.empty()) return std::numeric_limits<double>::infinity();
  double cost = 0.0;
  for (const std::vector<CutSolid>* side : {&cut.above, &cut.below}) {
    for (const CutSolid& piece : *side) {
      const ConvexBody body = convex_body(piece.points());
      if (body.empty()) continue;
      cost += with_distances ? hull_cost(body, piece.volume())
                             : std::max(0.0, body.volume - piece.volume());
    }
  }
  return cost;
}

void add_plane(const Vector3& normal, const Vector3& point, std::vector<CutPlane>& planes) {
  if (normal.norm() > 0.0) planes.push_back({normal.normalized(), normal.normalized().dot(point)});
}

void add_slices(const ConvexBody& body, const Eigen::Matrix3d& axes,
                std::vector<CutPlane>& planes) {
  constexpr int slices = 12;
  for (int axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vector3& p : body.hull.points) {
      low = std::min(low, axes.col(axis).dot(p));
      high = std::max(high, axes.col(axis).dot(p));
    }
    for (int k = 1; k < slices; ++k) {
      planes.push_back({axes.col(axis), low + (high - low) * k / slices});
    }
  }
}

/// Adds planes in many directions through the deepest points below the hull that are apart.
void add_dent_cuts(const CutSolid& solid, const ConvexBody& body, const Eigen::Matrix3d& axes,
                   std::vector<CutPlane>& planes) {
  constexpr int dents = 3;
  const std::vector<Vector3>& points = solid.points();
  std::vector<double> depths;
  depths.reserve(points.size());
  for (const Vector3& p : points) depths.push_back(-body.excess(p));
  const double apart = 0.5 * portable::cbrt(solid.volume());
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
    // Half of the 26 directions to a cube's faces, edges and corners.
    for (int k = 14; k < 27; ++k) {
      const Eigen::Vector3i direction(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
      add_plane(axes * direction.cast<double>(), points[deepest], planes);
    }
  }
}

/// Adds planes along the edges at which the body bends inward most, far below the hull: the planes
/// of both faces, and the plane between.
void add_edge_cuts(const CutSolid& solid, const ConvexBody& body, std::vector<CutPlane>& planes) {
  constexpr std::size_t most_edges = 8;
  const std::vector<Vector3>& p = solid.points();
  struct Weighted {
    double weight;
    CutSolid::ReflexEdge edge;
  };
  std::vector<Weighted> reflexes;
  for (const CutSolid::ReflexEdge& reflex : solid.reflex_edges()) {
    const auto& [a, b] = reflex.edge;
    // Some degrees: less is a curved surface, whose dents get their own planes.
    const double sine = reflex.first.cross(reflex.second).norm();
    if (!(sine > 0.15)) continue;
    const double depth = std::max(0.0, -body.excess(0.5 * (p[a] + p[b])));
    reflexes.push_back({(p[b] - p[a]).norm() * sine * (depth + 1e-9), reflex});
  }
  std::stable_sort(reflexes.begin(), reflexes.end(), [](const Weighted& one, const Weighted& two) {
    return one.weight > two.weight;
  });
  for (std::size_t k = 0; k < std::min(most_edges, reflexes.size()); ++k) {
    const CutSolid::ReflexEdge& reflex = reflexes[k].edge;
    const Vector3& a = p[reflex.edge[0]];
    add_plane(reflex.first, a, planes);
    add_plane(reflex.second, a, planes);
    add_plane(reflex.first - reflex.second, a, planes);
  }
}

/// Returns the first `wanted` planes by ascending score, without planes of infinite score.
template <class Score>
std::vector<CutPlane> sorted_by(const std::vector<CutPlane>& planes, std::size_t wanted,
                                const Execution& execution, const Score& score) {
  std::vector<double> scores(std::min(wanted, planes.size()));
  execution.parallel_for_each(scores.size(), 1,
                              [&](std::size_t i) { scores[i] = score(planes[i]); });
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

std::vector<CutPlane> best_cuts(const CutSolid& solid, const ConvexBody& body,
                                const Eigen::Matrix3d& axes, const HullCost& cost,
                                const Execution& execution) {
  std::vector<CutPlane> planes;
  add_edge_cuts(solid, body, planes);
  add_slices(body, axes, planes);
  add_dent_cuts(solid, body, axes, planes);
  // First the planes with the least excess volume, then the nearest of them.
  constexpr std::size_t measured = 24;
  planes = sorted_by(planes, planes.size(), execution,
                     [&](const CutPlane& plane) { return cut_cost(solid, plane, cost, false); });
  return sorted_by(planes, measured, execution,
                   [&](const CutPlane& plane) { return cut_cost(solid, plane, cost, true); });
}

}  // namespace wscvt
