// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wscvt {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;

constexpr const char* intersection_stage = "Looking for intersecting triangles";

Kernel::Point_3 exact(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

CGAL::Bbox_3 box_of(const std::vector<Vector3>& points, const Triangle& t) {
  const Vector3 low = points[t[0]].cwiseMin(points[t[1]]).cwiseMin(points[t[2]]);
  const Vector3 high = points[t[0]].cwiseMax(points[t[1]]).cwiseMax(points[t[2]]);
  return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

bool is_flat(const std::vector<Vector3>& points, const Triangle& t) {
  return CGAL::collinear(exact(points[t[0]]), exact(points[t[1]]), exact(points[t[2]]));
}

/// Collects candidates, and keeps those that intersect.
class PairDecider {
 public:
  PairDecider(const IndexedMesh& mesh, std::vector<TrianglePair>& pairs, const Execution& execution)
      : mesh_(mesh), pairs_(pairs), execution_(execution) {}

  void add(std::int32_t a, std::int32_t b) {
    constexpr std::size_t candidates_at_once = 1 << 16;  // some hundredths of a second
    candidates_.emplace_back(std::minmax(a, b));
    if (candidates_.size() == candidates_at_once) decide();
  }

  void decide() {
    constexpr std::size_t block_size = 256;
    meet_.assign(candidates_.size(), 0);
    execution_.parallel_for(
        candidates_.size(), block_size, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b] = candidates_[i];
            meet_[i] = triangles_meet(mesh_.points, mesh_.triangles[a], mesh_.triangles[b]) ? 1 : 0;
          }
        });
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (meet_[i] != 0) pairs_.push_back(candidates_[i]);
    }
    candidates_.clear();
  }

 private:
  const IndexedMesh& mesh_;
  std::vector<TrianglePair>& pairs_;
  const Execution& execution_;
  std::vector<TrianglePair> candidates_;
  std::vector<char> meet_;
};

}  // namespace

std::vector<TrianglePair> self_intersections(const IndexedMesh& mesh, const Execution& execution) {
  execution.report(0.0, intersection_stage);
  std::vector<TrianglePair> pairs;
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto number = static_cast<std::int32_t>(t);
    if (is_flat(mesh.points, mesh.triangles[t])) {
      pairs.emplace_back(number, number);
    } else {
      boxes.emplace_back(box_of(mesh.points, mesh.triangles[t]), number);
    }
  }
  // Not CGAL's Polygon_mesh_processing::self_intersections, which tests the same pairs of boxes: it
  // needs a half-edge mesh first, and cannot be cancelled.
  PairDecider decider(mesh, pairs, execution);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    decider.add(a.info(), b.info());
  });
  decider.decide();
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<TrianglePair> self_intersections_of(const std::vector<std::int32_t>& asked,
                                                const IndexedMesh& mesh,
                                                const Execution& execution) {
  std::vector<TrianglePair> pairs;
  if (asked.empty()) return pairs;
  execution.report(0.0, intersection_stage);
  // Of floats, because all triangles have a box. They are about a point of the mesh, and a little
  // larger, because floats have few digits.
  using FloatBox = CGAL::Box_intersection_d::Box_with_info_d<float, 3, std::int32_t>;
  const Vector3 origin = mesh.points[mesh.triangles.front()[0]];
  const auto float_box_of = [&](std::int32_t t) {
    constexpr double rounding = 1e-6;
    const CGAL::Bbox_3 box = box_of(mesh.points, mesh.triangles[t]);
    float low[3];
    float high[3];
    for (int k = 0; k < 3; ++k) {
      const double least = box.min(k) - origin[k];
      const double most = box.max(k) - origin[k];
      low[k] = static_cast<float>(least - rounding * std::abs(least));
      high[k] = static_cast<float>(most + rounding * std::abs(most));
    }
    return FloatBox(low, high, t);
  };
  std::vector<FloatBox> all;
  all.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    all.push_back(float_box_of(static_cast<std::int32_t>(t)));
  }
  std::vector<FloatBox> some;
  for (const std::int32_t t : asked) {
    if (is_flat(mesh.points, mesh.triangles[t])) {
      pairs.emplace_back(t, t);
    } else {
      some.push_back(all[static_cast<std::size_t>(t)]);
    }
  }
  PairDecider decider(mesh, pairs, execution);
  CGAL::box_intersection_d(
      some.begin(), some.end(), all.begin(), all.end(), [&](const FloatBox& a, const FloatBox& b) {
        if (a.info() == b.info() || is_flat(mesh.points, mesh.triangles[b.info()])) return;
        decider.add(a.info(), b.info());
      });
  decider.decide();
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

bool triangles_meet(const std::vector<Vector3>& points, const Triangle& a, const Triangle& b) {
  const auto point = [&](std::int32_t v) { return exact(points[v]); };
  const auto triangle = [&](const Triangle& t) {
    return Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2]));
  };
  const auto is_in = [](const Triangle& t, std::int32_t v) {
    return std::find(t.begin(), t.end(), v) != t.end();
  };
  // Rotates the corners of a triangle so that the first one meets the condition.
  const auto turned = [](Triangle t, const auto& is_first) {
    std::rotate(t.begin(), std::find_if(t.begin(), t.end(), is_first), t.end());
    return t;
  };
  const auto shared = std::count_if(a.begin(), a.end(), [&](auto v) { return is_in(b, v); });
  if (shared == 0) return CGAL::do_intersect(triangle(a), triangle(b));
  if (shared == 3) return true;
  if (shared == 2) {
    const Triangle t = turned(a, [&](auto v) { return !is_in(b, v); });
    const Triangle other = turned(b, [&](auto v) { return !is_in(a, v); });
    // Triangles with a common edge intersect only if they overlap in one plane.
    return CGAL::coplanar(point(t[1]), point(t[2]), point(t[0]), point(other[0])) &&
           CGAL::coplanar_orientation(point(t[1]), point(t[2]), point(t[0]), point(other[0])) ==
               CGAL::POSITIVE;
  }
  // They intersect beyond the corner if the far side of one passes through the other.
  const auto far_side = [&](const Triangle& t, const Triangle& other) {
    const Triangle from_corner = turned(t, [&](auto v) { return is_in(other, v); });
    return Kernel::Segment_3(point(from_corner[1]), point(from_corner[2]));
  };
  return CGAL::do_intersect(far_side(a, b), triangle(b)) ||
         CGAL::do_intersect(far_side(b, a), triangle(a));
}

std::vector<std::int32_t> vertices_of(const std::vector<TrianglePair>& pairs,
                                      const std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> vertices;
  for (const auto& [a, b] : pairs) {
    vertices.insert(vertices.end(), triangles[a].begin(), triangles[a].end());
    vertices.insert(vertices.end(), triangles[b].begin(), triangles[b].end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

CrossingPairs crossing_pairs(const IndexedMesh& mesh, const Execution& execution) {
  // Finds 5 of the faces of a dent that has a hundredth of them.
  constexpr std::size_t most_asked = 500;
  // Boxes of more would take more memory than the rest of a run.
  constexpr std::size_t most_faces = 2000000;
  const std::size_t faces = mesh.triangles.size();
  if (faces > most_faces) return {0, false};
  std::vector<std::int32_t> asked(std::min(faces, most_asked));
  for (std::size_t k = 0; k < asked.size(); ++k) {
    asked[k] = static_cast<std::int32_t>(k * faces / asked.size());
  }
  const std::vector<TrianglePair> pairs = self_intersections_of(asked, mesh, execution);
  // A triangle without area is no sheet.
  const auto count = std::count_if(pairs.begin(), pairs.end(), [](const TrianglePair& pair) {
    return pair.first != pair.second;
  });
  return {static_cast<std::size_t>(count), asked.size() == faces};
}

std::string crossing_sentence(const CrossingPairs& pairs, const std::string& whose) {
  if (pairs.count == 0) return "";
  return (pairs.is_all ? "" : "At least ") + std::to_string(pairs.count) +
         (pairs.count == 1 ? " pair" : " pairs") + " of triangles of " + whose +
         " intersect. Where one sheet passes through another, the surface is not that of a body, "
         "and its volume is counted twice or not at all. Repair it there first.";
}

namespace {

/// Largest number of rounds; most knots are separated in two or three.
constexpr int most_parting_rounds = 20;
/// Largest number of rings of nodes that move with a knot.
constexpr int most_rings = 3;

/// A move of the nodes of a knot.
struct KnotMove {
  double outwards;  ///< along the star's normal, in mean edges
  double inwards;   ///< fraction of the way to the middle of the ring
};
constexpr KnotMove knot_moves[] = {{0.05, 0.0}, {0.15, 0.0}, {0.0, 0.3}, {0.0, 0.7}, {0.1, 0.5}};

std::vector<TrianglePair> pairs_of(const EditMesh& mesh, const Execution& execution) {
  return self_intersections({mesh.points, mesh.triangles}, execution);
}

std::vector<std::int32_t> with_rings(const EditMesh& mesh, const std::vector<std::int32_t>& nodes,
                                     int rings) {
  std::vector<std::int32_t> all = nodes;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<std::int32_t> inner = all;
    for (const std::int32_t v : inner) {
      mesh.around(v, [&](std::int32_t h) { all.push_back(mesh.target(h)); });
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
  return all;
}

std::vector<Vector3> moved(const EditMesh& mesh, const std::vector<std::int32_t>& nodes,
                           const KnotMove& move, double edge) {
  std::vector<Vector3> points = mesh.points;
  for (const std::int32_t v : nodes) {
    Vector3 normal = Vector3::Zero();
    Vector3 middle = Vector3::Zero();
    mesh.around(v, [&](std::int32_t h) {
      normal += mesh.normal(face_of(h));
      middle += mesh.points[mesh.target(h)] / static_cast<double>(mesh.degrees[v]);
    });
    const double length = normal.norm();
    if (length > 0.0) points[v] += move.outwards * edge / length * normal;
    points[v] += move.inwards * (middle - mesh.points[v]);
  }
  return points;
}

}  // namespace

PartingReport part_triangles(EditMesh& mesh, const Execution& execution) {
  std::vector<TrianglePair> pairs = pairs_of(mesh, execution);
  PartingReport report = {pairs.size(), pairs.size()};
  const double edge = pairs.empty() ? 0.0 : mean_edge_length(mesh);
  int rings = 0;
  for (int round = 0; round < most_parting_rounds && !pairs.empty() && rings <= most_rings;
       ++round) {
    const std::vector<std::int32_t> nodes =
        with_rings(mesh, vertices_of(pairs, mesh.triangles), rings);
    std::vector<Vector3> best_points;
    for (const KnotMove& move : knot_moves) {
      EditMesh candidate = mesh;
      candidate.points = moved(mesh, nodes, move, edge);
      std::vector<TrianglePair> left = pairs_of(candidate, execution);
      if (left.size() >= pairs.size()) continue;
      pairs = std::move(left);
      best_points = std::move(candidate.points);
    }
    if (best_points.empty()) {
      ++rings;
    } else {
      mesh.points = std::move(best_points);
    }
  }
  report.after = pairs.size();
  return report;
}

}  // namespace wscvt
