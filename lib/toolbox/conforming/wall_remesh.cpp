// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/wall_remesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

// Of the wanted length; the usual bounds, between which splitting and collapsing cannot alternate.
constexpr double longest_share = 4.0 / 3.0;
constexpr double shortest_share = 4.0 / 5.0;

// Of the wanted length: shorter edges, and walls that are narrower, leave flat tetrahedra.
constexpr double narrow_share = 0.4;

// Of the wanted length: lines about walls of a few faces of voxels. With `narrow_share`, triangles
// intersect in gaps of a voxel.
constexpr double tiny_share = 0.25;

constexpr double flat_evenness = 0.1;  ///< angles of about 2 or 4 degrees

// Triangles do not become flatter, see WallMesh::collapse.
constexpr double least_evenness = 0.33;

constexpr std::size_t relaxation_block = 2048;  ///< vertices
constexpr double unlimited = 1e300;

}  // namespace

WallRemesher::WallRemesher(const DenseWalls& dense, std::vector<double> edges)
    : dense_(dense), edges_(std::move(edges)), first_edges_(edges_), mesh_(dense) {}

double WallRemesher::edge_of(const WallTriangle& t) const {
  const double inner = edges_[t.inner];
  return factor_ * (t.outer < 0 ? inner : std::sqrt(inner * edges_[t.outer]));
}

double WallRemesher::wanted(std::int32_t a, std::int32_t b) const {
  double sum = 0.0;
  double count = 0.0;
  mesh_.visit_triangles(a, [&](std::size_t t) {
    const Triangle& c = mesh_.triangles[t].corners;
    if (c[0] != b && c[1] != b && c[2] != b) return;
    sum += edge_of(mesh_.triangles[t]);
    count += 1.0;
  });
  return sum / count;
}

void WallRemesher::collapse_short(double most) {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3 && mesh_.is_alive(t); ++k) {
      const std::int32_t a = mesh_.triangles[t].corners[k];
      const std::int32_t b = mesh_.triangles[t].corners[following(k)];
      const double square = (mesh_.points[a] - mesh_.points[b]).squaredNorm();
      if (square > most * most) continue;
      const double length = wanted(a, b);
      double limit = std::min(most, shortest_share * length);
      if (mesh_.places[a] != WallPlace::Wall && mesh_.places[b] != WallPlace::Wall) {
        const bool are_points =
            mesh_.places[a] == WallPlace::Point && mesh_.places[b] == WallPlace::Point;
        if (are_points || !mesh_.is_line(mesh_.triangles_at(a, b))) {
          limit = std::min(limit, narrow_share * length);
        }
      }
      if (square > limit * limit) continue;
      // The shorter the edge, the flatter are its own triangles, and the flatter may others become.
      // Sheets beside thin gaps of voxels would intersect then.
      const double evenness =
          mesh_.drops_walls ? std::min(least_evenness, std::sqrt(square) / length) : least_evenness;
      if (join(a, b, longest_share * std::min(length, 2.0 * most), evenness)) k = 3;
    }
  }
}

void WallRemesher::collapse_narrow() {
  const bool drops_walls = mesh_.drops_walls;
  mesh_.drops_walls = true;
  // Pits and peaks of single voxels are needles, beside which no smaller turn is left.
  mesh_.least_cosine = 0.0;
  mesh_.follows_dense = false;
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3 && mesh_.is_alive(t); ++k) {
      const std::int32_t a = mesh_.triangles[t].corners[k];
      const std::int32_t b = mesh_.triangles[t].corners[following(k)];
      const double length = wanted(a, b);
      const double share = (mesh_.points[a] - mesh_.points[b]).norm() / length;
      const bool is_within = std::min(mesh_.places[a], mesh_.places[b]) == WallPlace::Wall;
      const bool is_flat = mesh_.evenness_of(t) < flat_evenness;
      if (share > (is_within || is_flat ? narrow_share : tiny_share)) continue;
      // Longer edges and flatter triangles than elsewhere: nothing else takes such an edge away.
      const double evenness = std::clamp(share, flat_evenness, least_evenness);
      if (join(a, b, 2.0 * length, evenness)) k = 3;
    }
  }
  mesh_.drops_walls = drops_walls;
  mesh_.least_cosine = usual_least_cosine;
  mesh_.follows_dense = true;
}

bool WallRemesher::join(std::int32_t a, std::int32_t b, double longest, double evenness) {
  if (mesh_.places[a] > mesh_.places[b]) std::swap(a, b);
  const bool is_between = mesh_.places[a] == mesh_.places[b];
  const Vector3 position =
      is_between ? Vector3(0.5 * (mesh_.points[a] + mesh_.points[b])) : mesh_.points[b];
  return mesh_.collapse(a, b, position, longest, evenness);
}

void WallRemesher::widen_small() {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (!mesh_.is_alone(t)) continue;
    const WallTriangle& wall = mesh_.triangles[t];
    std::array<Vector3, 3> x;
    double shortest = unlimited;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = mesh_.points[wall.corners[k]];
      const Vector3& next = mesh_.points[wall.corners[following(k)]];
      shortest = std::min(shortest, (next - x[k]).norm());
    }
    const double least = narrow_share * edge_of(wall) / factor_;
    const Vector3 normal = doubled_area_normal(x[0], x[1], x[2]).normalized();
    if (shortest >= least || normal.isZero()) continue;
    const Vector3 middle = (x[0] + x[1] + x[2]) / 3.0;
    constexpr double sine = 0.8660254037844386;  // of 120 degrees
    const auto turned = [&](const Vector3& arm, double way) -> Vector3 {
      return -0.5 * arm + way * sine * normal.cross(arm);
    };
    // The mean of the arms, turned onto the first one: that of the nearest even triangle.
    const Vector3 mean = x[0] - middle + turned(x[1] - middle, -1.0) + turned(x[2] - middle, 1.0);
    const Vector3 arm = least / (2.0 * sine) * mean.normalized();
    const std::array<Vector3, 3> even = {middle + arm, middle + turned(arm, 1.0),
                                         middle + turned(arm, -1.0)};
    for (std::size_t k = 0; k < 3; ++k) mesh_.points[wall.corners[k]] = even[k];
  }
}

void WallRemesher::split_long() {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (!mesh_.is_alive(t)) continue;
    // Longest first; a triangle is looked at again after a split.
    for (bool again = true; again;) {
      again = false;
      std::size_t longest = 0;
      double square = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Triangle& c = mesh_.triangles[t].corners;
        const double s = (mesh_.points[c[k]] - mesh_.points[c[following(k)]]).squaredNorm();
        if (s <= square) continue;
        square = s;
        longest = k;
      }
      const std::int32_t a = mesh_.triangles[t].corners[longest];
      const std::int32_t b = mesh_.triangles[t].corners[following(longest)];
      const double limit = longest_share * wanted(a, b);
      if (square <= limit * limit) continue;
      mesh_.split(a, b);
      again = true;
    }
  }
}

void WallRemesher::flip_all(bool only_flat) {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3 && mesh_.is_alive(t); ++k) {
      const std::int32_t a = mesh_.triangles[t].corners[k];
      const std::int32_t b = mesh_.triangles[t].corners[following(k)];
      if ((!only_flat || mesh_.is_flat(a, b)) && mesh_.flip(a, b)) break;
    }
  }
}

Vector3 WallRemesher::relaxed(std::int32_t v) const {
  const Vector3& p = mesh_.points[v];
  if (mesh_.places[v] == WallPlace::Line) {
    const WallVertices ends = mesh_.line_neighbours(v);
    if (ends.size() != 2) return p;
    return 0.5 * p + 0.25 * (mesh_.points[ends[0]] + mesh_.points[ends[1]]);
  }
  // The centroid of the triangles about the node, without the part along the normal.
  Vector3 sum = Vector3::Zero();
  Vector3 normal = Vector3::Zero();
  double area = 0.0;
  mesh_.visit_triangles(v, [&](std::size_t t) {
    const Triangle& c = mesh_.triangles[t].corners;
    const Vector3& x = mesh_.points[c[0]];
    const Vector3& y = mesh_.points[c[1]];
    const Vector3& z = mesh_.points[c[2]];
    const Vector3 n = doubled_area_normal(x, y, z);
    const double weight = n.norm();
    normal += n;
    area += weight;
    sum += weight / 3.0 * (x + y + z);
  });
  const double square = normal.squaredNorm();
  if (!(area > 0.0) || !(square > 0.0)) return p;
  const Vector3 move = sum / area - p;
  return p + move - move.dot(normal) / square * normal;
}

WallPoint WallRemesher::placed(std::int32_t v, const Vector3& target) const {
  const std::int32_t anchor = mesh_.anchors[v];
  if (anchor < 0) return {target, anchor};
  if (mesh_.places[v] == WallPlace::Line) return dense_.nearest_on_line(anchor, target);
  WallPoint place{target, anchor};
  bool is_first = true;
  mesh_.visit_triangles(v, [&](std::size_t t) {
    if (!is_first) return;
    is_first = false;
    place =
        dense_.nearest_on_wall(anchor, target, mesh_.triangles[t].inner, mesh_.triangles[t].outer);
  });
  return place;
}

void WallRemesher::relax(int times, const Execution& execution) {
  std::vector<WallPoint> moved(mesh_.vertex_count());
  for (int time = 0; time < times; ++time) {
    execution.parallel_for_each(moved.size(), relaxation_block, [&](std::size_t k) {
      const auto v = static_cast<std::int32_t>(k);
      moved[k] = {mesh_.points[k], mesh_.anchors[k]};
      bool is_alive = false;
      mesh_.visit_triangles(v, [&](std::size_t) { is_alive = true; });
      if (is_alive && mesh_.places[k] != WallPlace::Point) moved[k] = placed(v, relaxed(v));
    });
    for (std::size_t k = 0; k < moved.size(); ++k) {
      // A move that turns a triangle over is left out.
      bool turns = false;
      mesh_.visit_triangles(static_cast<std::int32_t>(k), [&](std::size_t t) {
        std::array<Vector3, 3> x;
        for (std::size_t c = 0; c < 3; ++c) {
          x[c] = mesh_.points[mesh_.triangles[t].corners[c]];
        }
        for (std::size_t c = 0; c < 3; ++c) {
          if (index(mesh_.triangles[t].corners[c]) == k) x[c] = moved[k].point;
        }
        if (!mesh_.may_become(t, mesh_.triangles[t].corners, x, 0.3, least_evenness)) turns = true;
      });
      if (turns) continue;
      mesh_.points[k] = moved[k].point;
      mesh_.anchors[k] = moved[k].vertex;
    }
  }
}

double WallRemesher::mean_ratio() const {
  // Each edge as often as it is in triangles.
  double sum = 0.0;
  double count = 0.0;
  for (const WallTriangle& t : mesh_.triangles) {
    if (t.corners[0] < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double length =
          (mesh_.points[t.corners[k]] - mesh_.points[t.corners[following(k)]]).norm();
      sum += length / (edge_of(t) / factor_);
      count += 1.0;
    }
  }
  return sum / count;
}

void WallRemesher::improve(int rounds, const Execution& execution) {
  for (int round = 0; round < rounds; ++round) {
    split_long();
    collapse_short(unlimited);
    flip_all(false);
    relax(2, execution);
  }
}

void WallRemesher::refine(const Execution& execution) {
  mesh_.drops_walls = true;
  // Cuts leave triangles that are flat and long. Their edges are halved with turns between, because
  // the parts of a long triangle are long as well.
  for (factor_ = 32.0; factor_ >= 1.0; factor_ *= 0.5) {
    execution.report(0.0, "Finding the walls");
    split_long();
    flip_all(true);
    flip_all(true);
  }
  factor_ = 1.0;
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    execution.report(static_cast<double>(round) / rounds, "Finding the walls");
    collapse_short(unlimited);
    mesh_.compact();
    split_long();
    flip_all(true);
  }
}

void WallRemesher::find_edges(int nodes, const std::vector<double>& least) {
  // A closed triangle mesh without handles has half as many nodes as triangles, and two.
  std::vector<double> counts(edges_.size(), 2.0);
  for (const WallTriangle& t : mesh_.triangles) {
    if (t.corners[0] < 0) continue;
    counts[t.inner] += 0.5;
    if (t.outer >= 0) counts[t.outer] += 0.5;
  }
  // Lines and points have no choice, and edges that follow them would run away.
  constexpr double most = 1.5;
  for (std::size_t g = 0; g < edges_.size(); ++g) {
    const double wanted = edges_[g] * std::sqrt(counts[g] / nodes);
    edges_[g] =
        std::max(least[g], std::clamp(wanted, first_edges_[g] / most, first_edges_[g] * most));
  }
}

void WallRemesher::run(const std::vector<double>& least, int nodes, const Execution& execution) {
  const double longest = *std::max_element(edges_.begin(), edges_.end());
  int level = 0;
  double most = *std::min_element(least.begin(), least.end());
  while (most < longest) {
    execution.report(0.3 * level / (level + 3.0), "Coarsening the walls");
    ++level;
    collapse_short(most);
    flip_all(false);
    mesh_.compact();
    relax(1, execution);
    most *= 1.6;
  }
  // Walls belong to two grains, so that numbers of nodes settle more slowly.
  const int rounds = nodes > 0 ? 6 : 3;
  for (int round = 0; round < rounds; ++round) {
    execution.report(0.3 + 0.6 * round / rounds, "Remeshing the walls");
    improve(2, execution);
    if (nodes > 0) {
      find_edges(nodes, least);
    } else {
      factor_ = std::clamp(factor_ / mean_ratio(), 0.5, 2.0);
    }
  }
  improve(2, execution);
  collapse_narrow();
  for (int round = 0; round < 3; ++round) {
    flip_all(false);
    relax(2, execution);
  }
  widen_small();
  // Nodes beside a widened wall are now too near to it.
  collapse_narrow();
  flip_all(false);
  mesh_.compact();
}

}  // namespace wscvt
