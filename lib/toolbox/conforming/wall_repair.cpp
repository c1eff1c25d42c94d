// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/wall_repair.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// Calls visit(key) for the cells of a grid that a triangle's box touches.
template <class Visit>
void visit_cells(const WallMesh& mesh, std::size_t t, double cell, const Visit& visit) {
  const auto& [a, b, c] = mesh.triangles[t].corners;
  const Vector3& x = mesh.points[index(a)];
  const Vector3& y = mesh.points[index(b)];
  const Vector3& z = mesh.points[index(c)];
  std::array<std::int64_t, 3> low{};
  std::array<std::int64_t, 3> high{};
  for (Eigen::Index k = 0; k < 3; ++k) {
    low[static_cast<std::size_t>(k)] =
        static_cast<std::int64_t>(std::floor(std::min({x[k], y[k], z[k]}) / cell));
    high[static_cast<std::size_t>(k)] =
        static_cast<std::int64_t>(std::floor(std::max({x[k], y[k], z[k]}) / cell));
  }
  constexpr std::int64_t bits = 21;
  constexpr std::int64_t mask = (std::int64_t{1} << bits) - 1;
  for (std::int64_t i = low[0]; i <= high[0]; ++i) {
    for (std::int64_t j = low[1]; j <= high[1]; ++j) {
      for (std::int64_t k = low[2]; k <= high[2]; ++k) {
        visit(((i & mask) << bits | (j & mask)) << bits | (k & mask));
      }
    }
  }
}

/// Returns the intersecting pairs of triangles; with `near`, only of those near its vertices.
std::vector<TrianglePair> pairs_of(const WallMesh& mesh, const std::vector<char>* near, double cell,
                                   const Execution& execution) {
  std::unordered_set<std::int64_t> cells;
  if (near != nullptr) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& c = mesh.triangles[t].corners;
      if (std::none_of(c.begin(), c.end(), [&](auto v) { return (*near)[index(v)] != 0; }))
        continue;
      visit_cells(mesh, t, cell, [&](std::int64_t key) { cells.insert(key); });
    }
  }
  IndexedMesh some;
  some.points = mesh.points;
  std::vector<std::int32_t> numbers;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bool is_in = near == nullptr;
    if (!is_in) {
      visit_cells(mesh, t, cell, [&](std::int64_t key) { is_in = is_in || cells.count(key) > 0; });
    }
    if (!is_in) continue;
    some.triangles.push_back(mesh.triangles[t].corners);
    numbers.push_back(static_cast<std::int32_t>(t));
  }
  std::vector<TrianglePair> pairs = self_intersections(some, execution.part(0.0, 0.0));
  for (auto& [a, b] : pairs) {
    a = numbers[index(a)];
    b = numbers[index(b)];
  }
  return pairs;
}

/// Returns the corners of the pairs, ascending.
std::vector<std::int32_t> corners_of(const WallMesh& mesh, const std::vector<TrianglePair>& pairs) {
  std::vector<std::int32_t> corners;
  for (const auto& [a, b] : pairs) {
    for (const std::int32_t t : {a, b}) {
      const Triangle& c = mesh.triangles[index(t)].corners;
      corners.insert(corners.end(), c.begin(), c.end());
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// Moves the nodes of intersecting triangles: sheets of free surface away from each other, by
/// `step`, others to the middle of their neighbours.
void part_pairs(WallMesh& mesh, const std::vector<TrianglePair>& pairs, double step) {
  std::vector<Vector3> shift(mesh.points.size(), Vector3::Zero());
  std::vector<char> is_knot(mesh.points.size(), 0);
  for (const auto& [first, second] : pairs) {
    const WallTriangle& a = mesh.triangles[index(first)];
    const WallTriangle& b = mesh.triangles[index(second)];
    const bool are_free = a.outer < 0 && b.outer < 0;
    const bool touch = std::any_of(a.corners.begin(), a.corners.end(), [&](std::int32_t corner) {
      return std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end();
    });
    for (const WallTriangle* t : {&a, &b}) {
      const Vector3 normal =
          doubled_area_normal(mesh.points[index(t->corners[0])], mesh.points[index(t->corners[1])],
                              mesh.points[index(t->corners[2])])
              .normalized();
      for (const std::int32_t corner : t->corners) {
        if (are_free && !touch) {
          shift[index(corner)] += a.inner == b.inner ? normal : Vector3(-normal);
        } else {
          is_knot[index(corner)] = 1;
        }
      }
    }
  }
  const std::vector<Vector3> before = mesh.points;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (is_knot[v] != 0) {
      Vector3 sum = Vector3::Zero();
      double count = 0.0;
      const auto add = [&](std::int32_t other) {
        sum += before[index(other)];
        count += 1.0;
      };
      if (mesh.places[v] == WallPlace::Line) {
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

}  // namespace

FinishedWalls finish_walls(WallMesh& mesh, const std::vector<double>& volumes, double voxel,
                           const Execution& execution) {
  constexpr int most_partings = 10;
  constexpr int most_restorations = 5;
  constexpr double step = 0.1;  // of a voxel; wide against rounding, small against a gap
  const double cell = 3.0 * voxel;
  std::vector<char> is_near(mesh.points.size(), 0);
  std::vector<TrianglePair> pairs = pairs_of(mesh, nullptr, cell, execution);
  for (int k = 0; k < most_partings && !pairs.empty(); ++k) {
    execution.report(0.02 * k, "Parting triangles");
    for (const std::int32_t v : corners_of(mesh, pairs)) is_near[index(v)] = 1;
    part_pairs(mesh, pairs, step * voxel);
    pairs = pairs_of(mesh, &is_near, cell, execution);
  }
  const std::vector<Vector3> parted = mesh.points;
  std::vector<double> shares(parted.size(), 1.0);
  FinishedWalls result;
  for (int k = 0; k < most_restorations; ++k) {
    execution.report(0.2 + 0.15 * k, "Restoring the volumes");
    mesh.points = parted;
    result.volume_error = restore_volumes(mesh.points, mesh.triangles, volumes, shares);
    // After the first time only moves about pairs change much.
    if (k > 0) result.pairs = pairs_of(mesh, &is_near, cell, execution);
    if (k == 0 || result.pairs.empty()) result.pairs = pairs_of(mesh, nullptr, cell, execution);
    if (result.pairs.empty()) break;
    for (const std::int32_t v : corners_of(mesh, result.pairs)) {
      shares[index(v)] *= 0.1;
      mesh.visit_triangles(v, [&](std::size_t t) {
        for (const std::int32_t c : mesh.triangles[t].corners) {
          is_near[index(c)] = 1;
          shares[index(c)] = std::min(shares[index(c)], 3.0 * shares[index(v)]);
        }
      });
    }
  }
  if (!result.pairs.empty()) result.pairs = pairs_of(mesh, nullptr, cell, execution);
  return result;
}

}  // namespace wscvt
