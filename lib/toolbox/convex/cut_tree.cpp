// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/cut_tree.h"

#include <algorithm>
#include <array>
#include <limits>

#include "wscvt/base/portable_math.h"
#include "wscvt/base/sorting.h"

namespace wscvt {

namespace {

constexpr std::size_t no_group = std::numeric_limits<std::size_t>::max();

/// Returns the plane shifted both ways, and turned both ways about two axes through its point
/// nearest to the middle of the points; by `step` at a distance of `size`.
std::array<CutPlane, 6> moved_planes(const CutPlane& plane, const std::vector<Vector3>& points,
                                     double size, double step) {
  Vector3 pivot = Vector3::Zero();
  for (const Vector3& p : points) pivot += p;
  pivot /= static_cast<double>(points.size());
  pivot -= (plane.normal.dot(pivot) - plane.offset) * plane.normal;
  const Vector3 first = plane.normal.unitOrthogonal();
  const Vector3 second = plane.normal.cross(first);
  std::array<CutPlane, 6> planes;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double move = k % 2 == 0 ? step : -step;
    planes[k] = plane;
    if (k < 2) {
      planes[k].offset += move;
    } else {
      planes[k].normal = (plane.normal + move / size * (k < 4 ? first : second)).normalized();
      planes[k].offset = planes[k].normal.dot(pivot);
    }
  }
  return planes;
}

}  // namespace

double total_cost(const std::vector<PieceGroup>& groups) {
  double total = 0.0;
  for (const PieceGroup& group : groups) total += group.cost;
  return total;
}

CutTree::CutTree(const IndexedMesh& mesh, const Eigen::Matrix3d& axes, const HullCost& cost)
    : axes_(axes), cost_(cost) {
  add_node(CutSolid(mesh));
}

void CutTree::add_node(CutSolid solid) {
  ConvexBody body = convex_body(solid.points());
  nodes_.push_back({std::move(solid), std::move(body), CutPlane(), {}, {}});
}

void CutTree::cut(std::size_t count, const Execution& execution) {
  std::vector<double> costs;  // zero for nodes that must not be cut
  // Cuts that take crumb after crumb from a piece would never end: few bodies need twice as many
  // cuts as pieces.
  const std::size_t most_cuts = 8 * count;
  std::size_t cuts = 0;
  for (std::size_t pieces = 1; pieces < count && cuts < most_cuts; ++cuts) {
    execution.report(static_cast<double>(pieces) / static_cast<double>(count),
                     "Cutting into convex parts");
    while (costs.size() < nodes_.size()) {
      const Node& node = nodes_[costs.size()];
      const double distance = node.body.empty() ? 0.0 : cost_.distance(node.body);
      costs.push_back(distance > cost_.tolerance() ? cost_(node.body, node.solid.volume()) : 0.0);
    }
    const auto worst = std::max_element(costs.begin(), costs.end());
    if (!(*worst > 0.0)) return;
    *worst = 0.0;
    const auto n = static_cast<std::size_t>(worst - costs.begin());
    const std::vector<CutPlane> planes =
        best_cuts(nodes_[n].solid, nodes_[n].body, axes_, cost_, execution);
    if (planes.empty()) continue;
    nodes_[n].plane = planes.front();
    SolidCut cut = nodes_[n].solid.cut(planes.front(), cost_.on_plane());
    for (CutSolid& solid : cut.above) {
      nodes_[n].above.push_back(nodes_.size());
      add_node(std::move(solid));
    }
    for (CutSolid& solid : cut.below) {
      nodes_[n].below.push_back(nodes_.size());
      add_node(std::move(solid));
    }
    // Crumbs of a rough surface, each some thousandths of a part, are useless as pieces.
    const double crumb = 0.01 * nodes_.front().solid.volume() / static_cast<double>(count);
    pieces = 0;
    for (const Node& node : nodes_)
      pieces += node.is_piece() && node.solid.volume() > crumb ? 1 : 0;
  }
}

std::vector<PieceGroup> CutTree::groups() const {
  std::vector<PieceGroup> groups;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    if (!node.is_piece() || node.body.empty()) continue;
    const double volume = node.solid.volume();
    groups.push_back({{n}, node.body, volume, cost_(node.body, volume)});
  }
  return groups;
}

std::vector<std::size_t> CutTree::group_of_nodes(const std::vector<PieceGroup>& groups) const {
  std::vector<std::size_t> group_of(nodes_.size(), no_group);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const std::size_t n : groups[g].pieces) group_of[n] = g;
  }
  return group_of;
}

/// Returns false if the solid falls into other pieces than before.
bool CutTree::cut_again(std::size_t node, CutSolid solid, const CutPlane& plane,
                        Solids& solids) const {
  const Node& old = nodes_[node];
  if (!old.is_piece()) {
    SolidCut cut = solid.cut(plane, cost_.on_plane());
    if (cut.above.size() != old.above.size() || cut.below.size() != old.below.size()) return false;
    const auto go_on = [&](const std::vector<std::size_t>& children, std::vector<CutSolid>& side) {
      for (std::size_t k = 0; k < children.size(); ++k) {
        const CutPlane& next = nodes_[children[k]].plane;
        if (!cut_again(children[k], std::move(side[k]), next, solids)) return false;
      }
      return true;
    };
    if (!go_on(old.above, cut.above) || !go_on(old.below, cut.below)) return false;
  }
  solids.emplace_back(node, std::move(solid));
  return true;
}

/// A moved plane and its consequences.
struct CutTree::Trial {
  Solids solids;                                           ///< of nodes
  std::vector<std::pair<std::size_t, PieceGroup>> groups;  ///< the changed groups
  double gain = 0.0;                                       ///< decrease of the groups' cost
};

CutTree::Trial CutTree::trial(std::size_t node, const CutPlane& plane,
                              const std::vector<PieceGroup>& groups,
                              const std::vector<std::size_t>& group_of) const {
  Trial result;
  if (!cut_again(node, nodes_[node].solid, plane, result.solids)) return {};
  std::vector<const CutSolid*> moved(nodes_.size(), nullptr);
  std::vector<std::size_t> changed;
  for (const auto& [n, solid] : result.solids) {
    moved[n] = &solid;
    if (group_of[n] != no_group) changed.push_back(group_of[n]);
  }
  sort_unique(changed);
  for (const std::size_t g : changed) {
    PieceGroup group;
    group.pieces = groups[g].pieces;
    std::vector<Vector3> points;
    for (const std::size_t n : group.pieces) {
      const bool is_moved = moved[n] != nullptr;
      const std::vector<Vector3>& own = is_moved ? moved[n]->points() : nodes_[n].body.hull.points;
      points.insert(points.end(), own.begin(), own.end());
      group.volume += is_moved ? moved[n]->volume() : nodes_[n].solid.volume();
    }
    group.body = convex_body(points);
    if (group.body.empty()) return {};
    group.cost = cost_(group.body, group.volume);
    result.gain += groups[g].cost - group.cost;
    result.groups.emplace_back(g, std::move(group));
  }
  return result;
}

/// Returns false if no move is a gain.
bool CutTree::move_plane(std::size_t node, double step, std::vector<PieceGroup>& groups,
                         const std::vector<std::size_t>& group_of, const Execution& execution) {
  constexpr double least_gain = 1e-5;
  const CutSolid& solid = nodes_[node].solid;
  const std::array<CutPlane, 6> planes =
      moved_planes(nodes_[node].plane, solid.points(), portable::cbrt(solid.volume()), step);
  std::array<Trial, 6> trials;
  execution.parallel_for_each(planes.size(), 1, [&](std::size_t k) {
    trials[k] = trial(node, planes[k], groups, group_of);
  });
  const auto best = std::max_element(trials.begin(), trials.end(),
                                     [](const auto& a, const auto& b) { return a.gain < b.gain; });
  if (!(best->gain > least_gain * total_cost(groups))) return false;
  nodes_[node].plane = planes[best - trials.begin()];
  for (auto& [moved, piece] : best->solids) {
    if (nodes_[moved].is_piece()) nodes_[moved].body = convex_body(piece.points());
    nodes_[moved].solid = std::move(piece);
  }
  for (auto& [g, group] : best->groups) groups[g] = std::move(group);
  return true;
}

void CutTree::move_planes(std::vector<PieceGroup>& groups, const Execution& execution) {
  constexpr int most_sweeps = 12;
  constexpr double first_step = 0.15;  // of the cube root of the grain's volume
  constexpr double last_step = 0.005;
  const std::vector<std::size_t> group_of = group_of_nodes(groups);
  const double size = portable::cbrt(nodes_.front().solid.volume());
  std::vector<double> steps(nodes_.size(), first_step * size);
  bool is_moving = true;
  for (int sweep = 0; sweep < most_sweeps && is_moving; ++sweep) {
    is_moving = false;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (nodes_[n].is_piece() || steps[n] < last_step * size) continue;
      execution.report(
          (sweep + static_cast<double>(n) / static_cast<double>(nodes_.size())) / most_sweeps,
          "Moving the cuts");
      is_moving = true;
      if (!move_plane(n, steps[n], groups, group_of, execution)) steps[n] *= 0.5;
    }
  }
}

void CutTree::collect(std::size_t node, const CutSolid& solid,
                      const std::vector<std::size_t>& group_of, std::vector<PieceGroup>& groups,
                      std::vector<std::vector<Vector3>>& points, const Execution& execution) const {
  execution.report(0.0, "Cutting the scan");
  const Node& old = nodes_[node];
  if (old.is_piece()) {
    const std::size_t g = group_of[node];
    if (g == no_group) return;
    groups[g].volume += solid.volume();
    points[g].insert(points[g].end(), solid.points().begin(), solid.points().end());
    return;
  }
  SolidCut cut = solid.cut(old.plane, cost_.on_plane());
  const auto go_on = [&](const std::vector<std::size_t>& children,
                         const std::vector<CutSolid>& side) {
    for (const CutSolid& part : side) {
      // Another mesh may fall into other pieces; each joins the piece in which it lies.
      std::size_t nearest = children.front();
      double least = std::numeric_limits<double>::infinity();
      for (const std::size_t child : children) {
        double most = -std::numeric_limits<double>::infinity();
        if (children.size() == 1) break;
        for (const Vector3& p : part.points()) {
          most = std::max(most, nodes_[child].body.excess(p));
        }
        if (!(most < least)) continue;
        least = most;
        nearest = child;
      }
      collect(nearest, part, group_of, groups, points, execution);
    }
  };
  // If a plane misses this mesh, all of it is on one side.
  if (cut.above.empty() && cut.below.empty()) {
    double height = 0.0;
    for (const Vector3& p : solid.points()) height += old.plane.normal.dot(p) - old.plane.offset;
    (height > 0.0 ? cut.above : cut.below).push_back(solid);
  }
  go_on(old.above, cut.above);
  go_on(old.below, cut.below);
}

std::vector<PieceGroup> CutTree::groups_of(const IndexedMesh& mesh,
                                           const std::vector<PieceGroup>& groups,
                                           const Execution& execution) const {
  std::vector<PieceGroup> result(groups.size());
  std::vector<std::vector<Vector3>> points(groups.size());
  collect(0, CutSolid(mesh), group_of_nodes(groups), result, points, execution);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    result[g].pieces = groups[g].pieces;
    result[g].body = convex_body(points[g]);
    if (!result[g].body.empty()) result[g].cost = cost_(result[g].body, result[g].volume);
  }
  return result;
}

}  // namespace wscvt
