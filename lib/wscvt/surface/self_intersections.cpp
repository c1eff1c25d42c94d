// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "wscvt/base/box_grid.h"
#include "wscvt/base/sorting.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr const char* intersection_stage = "Looking for intersecting triangles";

Kernel::Point_3 exact(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

bool is_flat(const std::array<Vector3, 3>& corners) {
  return CGAL::collinear(exact(corners[0]), exact(corners[1]), exact(corners[2]));
}

/// Pairs of several parts of a mesh.
struct FoundPairs {
  std::vector<TrianglePair> pairs;

  FoundPairs& operator+=(const FoundPairs& other) {
    pairs.insert(pairs.end(), other.pairs.begin(), other.pairs.end());
    return *this;
  }
};

}  // namespace

std::vector<TrianglePair> self_intersections(const IndexedMesh& mesh, const Execution& execution) {
  std::vector<std::int32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return self_intersections_of(all, mesh, execution);
}

std::vector<TrianglePair> self_intersections_of(const std::vector<std::int32_t>& asked,
                                                const IndexedMesh& mesh,
                                                const Execution& execution) {
  execution.report(0.0, intersection_stage);
  std::vector<TrianglePair> pairs;
  std::vector<BoxGrid::Box> boxes;
  std::vector<std::int32_t> triangles;  // of the boxes
  std::vector<char> is_asked(mesh.triangles.size(), 0);
  for (const std::int32_t t : asked) {
    if (is_asked[t] != 0) continue;
    is_asked[t] = 1;
    const std::array<Vector3, 3> corners = corners_of(mesh, t);
    if (is_flat(corners)) {
      pairs.emplace_back(t, t);
    } else {
      boxes.push_back(box_of(corners));
      triangles.push_back(t);
    }
  }
  // Not CGAL's box_intersection_d: it sorts the boxes of all triangles, on one thread. 500 asked of
  // 82,000 take a third of its time here.
  const BoxGrid grid(std::move(boxes));
  constexpr std::size_t faces_a_part = 256;
  const FoundPairs found = execution.parallel_sum(
      mesh.triangles.size(), faces_a_part, FoundPairs(), [&](std::size_t begin, std::size_t end) {
        FoundPairs part;
        std::vector<std::int32_t> near;
        for (auto f = static_cast<std::int32_t>(begin); f < static_cast<std::int32_t>(end); ++f) {
          const std::array<Vector3, 3> corners = corners_of(mesh, f);
          grid.find(box_of(corners), near);
          if (near.empty() || is_flat(corners)) continue;
          for (const std::int32_t box : near) {
            const std::int32_t t = triangles[box];
            // Of two that are asked, the later one finds the pair.
            const bool is_other = is_asked[f] != 0 ? t < f : t != f;
            if (is_other && triangles_meet(mesh.points, mesh.triangles[t], mesh.triangles[f])) {
              part.pairs.emplace_back(std::minmax(t, f));
            }
          }
        }
        return part;
      });
  pairs.insert(pairs.end(), found.pairs.begin(), found.pairs.end());
  std::sort(pairs.begin(), pairs.end());
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
  sort_unique(vertices);
  return vertices;
}

CrossingPairs crossing_pairs(const IndexedMesh& mesh, const Execution& execution) {
  // Finds 5 of the faces of a dent that has a hundredth of them.
  constexpr std::size_t most_asked = 500;
  const std::size_t faces = mesh.triangles.size();
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
  return (pairs.is_all ? "" : "At least ") + format_count(pairs.count, "pair") +
         " of triangles of " + whose +
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
    sort_unique(all);
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
