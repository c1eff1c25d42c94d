// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/intersection_repair.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "wscvt/surface/self_intersections.h"

namespace wscvt {

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
