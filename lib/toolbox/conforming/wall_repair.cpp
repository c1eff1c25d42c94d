// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "toolbox/conforming/wall_remesh.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// The walls as a mesh, whose triangles stay while its points move.
class WallPairs {
 public:
  explicit WallPairs(const WallMesh& walls) {
    for (const WallTriangle& t : walls.triangles) mesh_.triangles.push_back(t.corners);
  }

  /// Returns the intersecting pairs of triangles at these points.
  std::vector<TrianglePair> all(const std::vector<Vector3>& points, const Execution& execution) {
    mesh_.points = points;
    return self_intersections(mesh_, execution.part(0.0, 0.0));
  }

  /// Returns those that have a triangle with a corner in `near`.
  std::vector<TrianglePair> near(const std::vector<Vector3>& points, const std::vector<char>& near,
                                 const Execution& execution) {
    mesh_.points = points;
    std::vector<std::int32_t> asked;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Triangle& c = mesh_.triangles[t];
      if (std::any_of(c.begin(), c.end(), [&](auto v) { return near[v] != 0; })) {
        asked.push_back(static_cast<std::int32_t>(t));
      }
    }
    return self_intersections_of(asked, mesh_, execution.part(0.0, 0.0));
  }

  const std::vector<Triangle>& triangles() const { return mesh_.triangles; }

 private:
  IndexedMesh mesh_;
};

/// Moves the nodes of intersecting triangles: sheets of free surface away from each other, by
/// `step`, others to the middle of their neighbours: along their line, unless its wall is `narrow`
/// and would shrink to a point. With `stay` the nodes of narrow walls do not move.
void part_pairs(WallMesh& mesh, const std::vector<TrianglePair>& pairs,
                const std::vector<char>& narrow, bool stay, double step) {
  std::vector<Vector3> shift(mesh.points.size(), Vector3::Zero());
  std::vector<char> is_knot(mesh.points.size(), 0);
  for (const auto& [first, second] : pairs) {
    const WallTriangle& a = mesh.triangles[first];
    const WallTriangle& b = mesh.triangles[second];
    const bool are_free = a.outer < 0 && b.outer < 0;
    const bool touch = std::any_of(a.corners.begin(), a.corners.end(), [&](std::int32_t corner) {
      return std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end();
    });
    for (const WallTriangle* t : {&a, &b}) {
      const Vector3 normal =
          doubled_area_normal(mesh.points[t->corners[0]], mesh.points[t->corners[1]],
                              mesh.points[t->corners[2]])
              .normalized();
      for (const std::int32_t corner : t->corners) {
        if (are_free && !touch) {
          shift[corner] += a.inner == b.inner ? normal : Vector3(-normal);
        } else {
          is_knot[corner] = 1;
        }
      }
    }
  }
  const std::vector<Vector3> before = mesh.points;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (stay && narrow[v] != 0) continue;
    if (is_knot[v] != 0) {
      Vector3 sum = Vector3::Zero();
      double count = 0.0;
      const auto add = [&](std::int32_t other) {
        sum += before[other];
        count += 1.0;
      };
      if (mesh.places[v] == WallPlace::Line && narrow[v] == 0) {
        for (const std::int32_t end : mesh.line_neighbours(static_cast<std::int32_t>(v))) add(end);
      } else {
        mesh.visit_triangles(static_cast<std::int32_t>(v), [&](std::size_t t) {
          for (const std::int32_t corner : mesh.triangles[t].corners) {
            if (index(corner) != v) add(corner);
          }
        });
      }
      if (count > 0.0) mesh.points[v] += 0.5 * (sum / count - before[v]);
    } else if (shift[v].squaredNorm() > 0.0) {
      mesh.points[v] += step * shift[v].normalized();
    }
  }
}

/// Marks the nodes of walls between grains that have no inner nodes.
std::vector<char> nodes_of_narrow_walls(const WallMesh& mesh) {
  const auto is_within = [&](std::int32_t v) { return mesh.places[v] == WallPlace::Wall; };
  std::vector<char> marked(mesh.points.size(), 0);
  for (const WallTriangle& t : mesh.triangles) {
    if (t.outer < 0 || std::any_of(t.corners.begin(), t.corners.end(), is_within)) continue;
    for (const std::int32_t v : t.corners) marked[v] = 1;
  }
  return marked;
}

}  // namespace

FinishedWalls finish_walls(WallMesh& mesh, const std::vector<double>& volumes, double dense_edge,
                           const Execution& execution) {
  constexpr int most_partings = 10;
  constexpr int most_restorations = 5;
  constexpr double step = 0.1;  // of a dense edge; wide against rounding, small against a gap
  WallPairs walls(mesh);
  // Parted nodes make a narrow wall uneven: first others move alone.
  const std::vector<char> narrow = nodes_of_narrow_walls(mesh);
  std::vector<char> is_near(mesh.points.size(), 0);
  std::vector<TrianglePair> pairs = walls.all(mesh.points, execution);
  for (int k = 0; k < most_partings && !pairs.empty(); ++k) {
    execution.report(0.02 * k, "Parting triangles");
    for (const std::int32_t v : vertices_of(pairs, walls.triangles())) is_near[v] = 1;
    part_pairs(mesh, pairs, narrow, 2 * k < most_partings, step * dense_edge);
    pairs = walls.near(mesh.points, is_near, execution);
  }
  const std::vector<Vector3> parted = mesh.points;
  std::vector<double> shares(parted.size(), 1.0);
  // Both sides of a wall of one triangle are narrow there, and would stretch it to a false contact:
  // by 18 % of its area between two pyramids, by 1 % with a twentieth of the move.
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.is_alone(t)) continue;
    for (const std::int32_t v : mesh.triangles[t].corners) shares[v] = 0.05;
  }
  FinishedWalls result;
  for (int k = 0; k < most_restorations; ++k) {
    execution.report(0.2 + 0.15 * k, "Restoring the volumes");
    mesh.points = parted;
    result.volume_error = restore_volumes(mesh, volumes, shares);
    // After the first time only moves about pairs change much.
    if (k > 0) result.pairs = walls.near(mesh.points, is_near, execution);
    if (k == 0 || result.pairs.empty()) result.pairs = walls.all(mesh.points, execution);
    if (result.pairs.empty()) break;
    for (const std::int32_t v : vertices_of(result.pairs, walls.triangles())) {
      shares[v] *= 0.1;
      mesh.visit_triangles(v, [&](std::size_t t) {
        for (const std::int32_t c : mesh.triangles[t].corners) {
          is_near[c] = 1;
          shares[c] = std::min(shares[c], 3.0 * shares[v]);
        }
      });
    }
  }
  if (!result.pairs.empty()) result.pairs = walls.all(mesh.points, execution);
  return result;
}

}  // namespace wscvt
