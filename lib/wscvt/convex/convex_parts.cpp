// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/convex/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/convex/convex_body.h"
#include "wscvt/convex/cut_choice.h"
#include "wscvt/convex/signed_grid.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

void check_options(const ConvexOptions& options) {
  require_in_range(options.parts, convex_parts_option);
  require_in_range(options.faces, convex_faces_option);
  require_in_range(options.tolerance, convex_tolerance_option);
}

namespace {

/// Pieces that one part stands for.
struct Group {
  ConvexBody body;      ///< the hull of all of them
  double volume = 0.0;  ///< of the pieces
};

std::vector<ConvexPiece> cut_into_pieces(const IndexedMesh& mesh, std::size_t count,
                                         double tolerance, const Eigen::Matrix3d& axes,
                                         const SignedGrid& grid, const Execution& execution) {
  constexpr std::size_t most_tries = 5;
  std::vector<ConvexPiece> pieces;
  pieces.push_back(convex_piece(ExactSolid(mesh), grid));
  while (pieces.size() < count) {
    execution.report(static_cast<double>(pieces.size()) / static_cast<double>(count),
                     "Cutting into convex parts");
    const auto worst = std::max_element(
        pieces.begin(), pieces.end(),
        [](const ConvexPiece& a, const ConvexPiece& b) { return a.distance < b.distance; });
    if (!(worst->distance > tolerance)) break;
    const std::vector<CutPlane> planes = best_cuts(*worst, axes, grid, execution);
    std::vector<ExactSolid> cut;
    for (std::size_t k = 0; k < std::min(most_tries, planes.size()) && cut.empty(); ++k) {
      cut = worst->solid.cut(planes[k]);
    }
    if (cut.empty()) {
      // It stays as it is, and is not tried again.
      worst->distance = 0.0;
      continue;
    }
    *worst = convex_piece(std::move(cut.front()), grid);
    for (std::size_t k = 1; k < cut.size(); ++k) {
      pieces.push_back(convex_piece(std::move(cut[k]), grid));
    }
  }
  return pieces;
}

/// Joins groups two by two.
class Joining {
 public:
  Joining(std::vector<Group> groups, const SignedGrid& grid, const Execution& execution)
      : groups_(std::move(groups)), grid_(grid), execution_(execution) {
    for (std::size_t a = 0; a < groups_.size(); ++a) {
      for (std::size_t b = a + 1; b < groups_.size(); ++b) pairs_.push_back({a, b, 0.0, 0.0});
    }
    measure(0);
  }

  /// Until there are no more than `count`, and no pair that can be joined within the tolerance.
  std::vector<Group> run(std::size_t count, double tolerance) {
    std::size_t left = groups_.size();
    while (left > 1) {
      const auto best =
          std::min_element(pairs_.begin(), pairs_.end(),
                           [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
      const auto free =
          std::min_element(pairs_.begin(), pairs_.end(),
                           [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
      if (left <= count && !(free->distance <= tolerance)) break;
      join(left <= count ? *free : *best);
      --left;
    }
    std::vector<Group> result;
    for (Group& group : groups_) {
      if (!group.body.empty()) result.push_back(std::move(group));
    }
    return result;
  }

 private:
  struct Pair {
    std::size_t first;
    std::size_t second;
    double cost;
    double distance;
  };

  ConvexBody common_hull(const Pair& pair) const {
    std::vector<Vector3> points = groups_[pair.first].body.hull.points;
    const std::vector<Vector3>& others = groups_[pair.second].body.hull.points;
    points.insert(points.end(), others.begin(), others.end());
    return convex_body(points);
  }

  void measure(std::size_t first_pair) {
    execution_.parallel_for(pairs_.size() - first_pair, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = first_pair + begin; k < first_pair + end; ++k) {
        Pair& pair = pairs_[k];
        const ConvexBody hull = common_hull(pair);
        pair.distance = hull_distance(hull.hull, grid_);
        pair.cost = hull_cost(
            pair.distance, hull.volume - groups_[pair.first].volume - groups_[pair.second].volume);
      }
    });
  }

  void join(Pair pair) {
    groups_[pair.first] = {common_hull(pair),
                           groups_[pair.first].volume + groups_[pair.second].volume};
    groups_[pair.second] = Group();
    // Pairs of either of the two go; those of the new one come.
    pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(),
                                [&](const Pair& other) {
                                  for (const std::size_t gone : {pair.first, pair.second}) {
                                    if (other.first == gone || other.second == gone) return true;
                                  }
                                  return false;
                                }),
                 pairs_.end());
    const std::size_t kept = pairs_.size();
    for (std::size_t other = 0; other < groups_.size(); ++other) {
      if (other == pair.first || groups_[other].body.empty()) continue;
      pairs_.push_back({std::min(other, pair.first), std::max(other, pair.first), 0.0, 0.0});
    }
    measure(kept);
  }

  std::vector<Group> groups_;
  std::vector<Pair> pairs_;
  const SignedGrid& grid_;
  const Execution& execution_;
};

/// Lets each point outside of all parts join the part that it is least outside of.
void take_in(const std::vector<Vector3>& points, std::vector<Group>& groups) {
  std::vector<std::vector<Vector3>> taken(groups.size());
  for (const Vector3& p : points) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t g = 0; g < groups.size() && least > 0.0; ++g) {
      const double excess = groups[g].body.excess(p);
      if (!(excess < least)) continue;
      least = excess;
      nearest = g;
    }
    if (least > 0.0 && std::isfinite(least)) taken[nearest].push_back(p);
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (taken[g].empty()) continue;
    std::vector<Vector3>& all = taken[g];
    const std::vector<Vector3>& own = groups[g].body.hull.points;
    all.insert(all.end(), own.begin(), own.end());
    groups[g].body = convex_body(all);
  }
}

}  // namespace

ConvexParts convex_parts(const IndexedMesh& mesh, const std::vector<Vector3>& scan,
                         const ConvexOptions& options, const Execution& execution) {
  check_options(options);
  std::vector<Group> groups;
  if (options.parts == 1) {
    groups.push_back({convex_body(scan.empty() ? mesh.points : scan), 0.0});
    if (groups.front().body.empty()) refuse("The grain is flat; give a closed mesh with a volume.");
  } else {
    // A sixtieth of a grain is some per cent of its radius: the size of the distances.
    constexpr int cells = 60;
    constexpr std::size_t pieces_a_part = 3;
    const ShapeDescriptors shape = describe_shape(mesh, execution.part(0.0, 0.0));
    const double radius = std::cbrt(3.0 * shape.volume / (4.0 * pi));
    const double tolerance = 0.01 * options.tolerance * radius;
    execution.report(0.0, "Cutting into convex parts");
    const SignedGrid grid(mesh, cells, execution.part(0.0, 0.1));
    const auto count = static_cast<std::size_t>(options.parts);
    const std::vector<ConvexPiece> pieces =
        cut_into_pieces(mesh, pieces_a_part * count, tolerance,
                        shape.principal_axes.toRotationMatrix(), grid, execution.part(0.1, 0.8));
    for (const ConvexPiece& piece : pieces) {
      if (!piece.body.empty()) groups.push_back({piece.body, piece.volume});
    }
    groups = Joining(std::move(groups), grid, execution.part(0.8, 0.9)).run(count, tolerance);
    take_in(scan, groups);
  }
  ConvexParts parts;
  for (const Group& group : groups) {
    execution.report(0.9, "Making hulls");
    parts.push_back(with_fewer_faces(group.body, options.faces).hull);
  }
  return parts;
}

ConvexParts parts_of(const IndexedMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  std::vector<std::vector<Vector3>> points;
  for (const Triangle& t : mesh.triangles) {
    const std::int32_t start = root(t[0]);
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
