// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/convex_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <utility>

#include "toolbox/convex/convex_body.h"
#include "toolbox/convex/cut_choice.h"
#include "toolbox/convex/cut_tree.h"
#include "toolbox/convex/signed_grid.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

void check_options(const ConvexOptions& options) {
  require_in_range(options.parts, convex_parts_option);
  require_in_range(options.faces, convex_faces_option);
  require_in_range(options.tolerance, convex_tolerance_option);
}

namespace {

/// Joins groups in pairs.
class Joining {
 public:
  Joining(std::vector<PieceGroup> groups, const HullCost& cost, const Execution& execution)
      : groups_(std::move(groups)), cost_(cost), execution_(execution) {
    for (std::size_t a = 0; a < groups_.size(); ++a) {
      boxes_.push_back(box_of(groups_[a].body.hull.points));
      if (groups_[a].body.empty()) continue;
      for (std::size_t b = 0; b < a; ++b) add_pair(b, a);
    }
    measure(0);
  }

  /// Joins until there are at most `count` groups, and no pair that is convex within the tolerance.
  std::vector<PieceGroup> run(std::size_t count) {
    std::size_t left = groups_.size();
    for (; !pairs_.empty(); --left) {
      const bool is_forced = left > count;
      const auto best =
          std::min_element(pairs_.begin(), pairs_.end(), [&](const Pair& a, const Pair& b) {
            return is_forced || a.is_convex == b.is_convex ? a.cost < b.cost : a.is_convex;
          });
      if (!is_forced && !best->is_convex) break;
      join(*best);
    }
    std::vector<PieceGroup> result;
    for (PieceGroup& group : groups_) {
      if (!group.body.empty()) result.push_back(std::move(group));
    }
    return result;
  }

 private:
  struct Pair {
    std::size_t first = 0;
    std::size_t second = 0;
    double cost = 0.0;  ///< of the common hull, less the costs of the two
    bool is_convex = false;
  };

  /// Adds a pair, unless the two cannot touch.
  void add_pair(std::size_t first, std::size_t second) {
    const double margin = 1e-6 * boxes_[first].diagonal().norm();
    if (boxes_[first].exteriorDistance(boxes_[second]) > margin) return;
    pairs_.push_back({first, second, 0.0, false});
  }

  ConvexBody common_hull(const Pair& pair) const {
    std::vector<Vector3> points = groups_[pair.first].body.hull.points;
    const std::vector<Vector3>& others = groups_[pair.second].body.hull.points;
    points.insert(points.end(), others.begin(), others.end());
    return convex_body(points);
  }

  void measure(std::size_t first_pair) {
    execution_.report(0.0, "Joining convex parts");
    execution_.parallel_for_each(pairs_.size() - first_pair, 1, [&](std::size_t k) {
      Pair& pair = pairs_[first_pair + k];
      const PieceGroup& one = groups_[pair.first];
      const PieceGroup& two = groups_[pair.second];
      const ConvexBody hull = common_hull(pair);
      const double volume = one.volume + two.volume;
      pair.cost = cost_(hull, volume) - one.cost - two.cost;
      pair.is_convex = cost_.distance(hull) <= cost_.tolerance();
    });
  }

  void join(Pair pair) {
    PieceGroup& one = groups_[pair.first];
    PieceGroup& two = groups_[pair.second];
    one.body = common_hull(pair);
    one.volume += two.volume;
    one.cost += two.cost + pair.cost;
    one.pieces.insert(one.pieces.end(), two.pieces.begin(), two.pieces.end());
    two = PieceGroup();
    boxes_[pair.first] = box_of(one.body.hull.points);
    // Replaces the pairs of the two by pairs of the new group.
    const auto is_gone = [&](const Pair& other) {
      for (const std::size_t gone : {pair.first, pair.second}) {
        if (other.first == gone || other.second == gone) return true;
      }
      return false;
    };
    pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), is_gone), pairs_.end());
    const std::size_t kept = pairs_.size();
    for (std::size_t other = 0; other < groups_.size(); ++other) {
      if (other == pair.first || groups_[other].body.empty()) continue;
      add_pair(std::min(other, pair.first), std::max(other, pair.first));
    }
    measure(kept);
  }

  std::vector<PieceGroup> groups_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<Pair> pairs_;
  const HullCost& cost_;
  const Execution& execution_;
};

std::vector<ConvexBody> bodies_of(const IndexedMesh& mesh, const IndexedMesh& scan,
                                  const ConvexOptions& options, const Execution& execution) {
  // A sixtieth of a grain is some per cent of its radius: the scale of the distances.
  constexpr int cells = 60;
  constexpr std::size_t pieces_a_part = 2;
  const ShapeDescriptors shape = describe_shape(mesh, execution.part(0.0, 0.0));
  const double radius = equivalent_radius(shape.volume);
  const auto count = static_cast<std::size_t>(options.parts);
  execution.report(0.0, "Cutting into convex parts");
  const SignedGrid grid(scan.triangles.empty() ? mesh : scan, cells, execution.part(0.0, 0.1));
  const HullCost cost(grid, 0.01 * options.tolerance * radius);
  const Eigen::Matrix3d axes = shape.principal_axes.toRotationMatrix();
  CutTree tree(mesh, axes, cost);
  tree.cut(pieces_a_part * count, execution.part(0.1, 0.5));
  std::vector<PieceGroup> groups =
      Joining(tree.groups(), cost, execution.part(0.5, 0.6)).run(count);
  tree.move_planes(groups, execution.part(0.6, 0.85));
  if (!scan.triangles.empty()) groups = tree.groups_of(scan, groups, execution.part(0.85, 0.9));
  // The scan's hulls may need fewer parts than the mesh's, whose edges are rounder.
  groups = Joining(std::move(groups), cost, execution.part(0.9, 0.95)).run(count);
  std::vector<ConvexBody> bodies;
  bodies.reserve(groups.size());
  for (PieceGroup& group : groups) bodies.push_back(std::move(group.body));
  return bodies;
}

}  // namespace

ConvexParts convex_parts(const IndexedMesh& mesh, const IndexedMesh& scan,
                         const ConvexOptions& options, const Execution& execution) {
  check_options(options);
  std::vector<ConvexBody> bodies;
  if (options.parts == 1) {
    bodies.push_back(convex_body(scan.points.empty() ? mesh.points : scan.points));
    if (bodies.front().empty()) refuse("The grain is flat. Give a closed mesh with a volume.");
  } else {
    bodies = bodies_of(mesh, scan, options, execution);
  }
  ConvexParts parts;
  for (const ConvexBody& body : bodies) {
    execution.report(0.95, "Making hulls");
    parts.push_back(with_fewer_faces(body, options.faces).hull);
  }
  return parts;
}

ConvexParts parts_of(const IndexedMesh& mesh) {
  boost::disjoint_sets_with_storage<> linked(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    linked.union_set(a, b);
    linked.union_set(b, c);
  }
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  std::vector<std::vector<Vector3>> points;
  for (const Triangle& t : mesh.triangles) {
    const std::size_t start = linked.find_set(t[0]);
    if (number[start] < 0) {
      number[start] = static_cast<std::int32_t>(points.size());
      points.emplace_back();
    }
    for (const std::int32_t v : t) points[number[start]].push_back(mesh.points[v]);
  }
  ConvexParts parts;
  for (const std::vector<Vector3>& part : points) {
    ConvexBody body = convex_body(part);
    if (!body.empty()) parts.push_back(std::move(body.hull));
  }
  return parts;
}

IndexedMesh joined(const ConvexParts& parts) {
  IndexedMesh mesh;
  for (const IndexedMesh& part : parts) {
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
    for (const auto& [a, b, c] : part.triangles) {
      mesh.triangles.push_back({a + first, b + first, c + first});
    }
  }
  return mesh;
}

}  // namespace wscvt
