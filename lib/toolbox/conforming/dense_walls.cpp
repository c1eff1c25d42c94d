// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/dense_walls.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t smoothing_block = 8192;  ///< vertices

/// Returns the neighbours of a vertex along lines: the ends of edges that are not between exactly
/// two faces of one wall. Ascending.
template <class Face>
std::vector<std::int32_t> line_ends(const std::vector<Face>& faces, const Groups& faces_at,
                                    std::size_t vertex) {
  std::vector<std::tuple<std::int32_t, std::int32_t, std::int32_t>> edges;
  for (const std::int32_t* f = faces_at.begin(vertex); f != faces_at.end(vertex); ++f) {
    const Face& face = faces[*f];
    const std::size_t sides = face.corners.size();
    for (std::size_t k = 0; k < sides; ++k) {
      if (index(face.corners[k]) != vertex) continue;
      edges.emplace_back(face.corners[(k + 1) % sides], face.inner, face.outer);
      edges.emplace_back(face.corners[(k + sides - 1) % sides], face.inner, face.outer);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::int32_t> ends;
  for (std::size_t k = 0; k < edges.size();) {
    std::size_t next = k + 1;
    while (next < edges.size() && std::get<0>(edges[next]) == std::get<0>(edges[k])) ++next;
    if (next != k + 2 || edges[k] != edges[k + 1]) ends.push_back(std::get<0>(edges[k]));
    k = next;
  }
  return ends;
}

/// What a displacement does to the volume of a grain.
struct VolumeGradient {
  std::int32_t grain;
  Vector3 gradient;
};

/// Collects gradients at a vertex; few grains.
void add_gradient(std::vector<VolumeGradient>& list, std::int32_t grain, const Vector3& gradient) {
  for (VolumeGradient& one : list) {
    if (one.grain != grain) continue;
    one.gradient += gradient;
    return;
  }
  list.push_back({grain, gradient});
}

/// Rows of a symmetric matrix of grains that touch.
class GrainMatrix {
 public:
  explicit GrainMatrix(std::size_t grains) : rows_(grains) {}

  void add(std::int32_t i, std::int32_t j, double value) {
    for (auto& [column, sum] : rows_[i]) {
      if (column != j) continue;
      sum += value;
      return;
    }
    rows_[i].emplace_back(j, value);
  }

  /// Solves by conjugate gradients, scaled by the diagonal.
  std::vector<double> solve(const std::vector<double>& b) const {
    const std::size_t n = rows_.size();
    std::vector<double> scale(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (const auto& [j, value] : rows_[i]) {
        if (index(j) == i && value > 0.0) scale[i] = 1.0 / value;
      }
    }
    std::vector<double> x(n, 0.0);
    std::vector<double> r = b;
    std::vector<double> p(n, 0.0);
    std::vector<double> ap(n, 0.0);
    double before = 1.0;
    double first = 0.0;
    for (int step = 0; step < 500; ++step) {
      double now = 0.0;
      for (std::size_t i = 0; i < n; ++i) now += r[i] * scale[i] * r[i];
      if (step == 0) first = now;
      if (now <= 1e-30 * first) break;
      for (std::size_t i = 0; i < n; ++i) {
        p[i] = scale[i] * r[i] + (step == 0 ? 0.0 : now / before) * p[i];
      }
      before = now;
      double curvature = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        ap[i] = 0.0;
        for (const auto& [j, value] : rows_[i]) ap[i] += value * p[j];
        curvature += p[i] * ap[i];
      }
      if (!(curvature > 0.0)) break;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += now / curvature * p[i];
        r[i] -= now / curvature * ap[i];
      }
    }
    return x;
  }

 private:
  std::vector<std::vector<std::pair<std::int32_t, double>>> rows_;
};

/// Returns the faces at each vertex.
template <class Face>
Groups faces_at_each(const std::vector<Face>& faces, std::size_t vertices) {
  return counting_sort(faces.size(), vertices, [&](std::size_t f, const auto& visit) {
    for (const std::int32_t corner : faces[f].corners) visit(index(corner));
  });
}

}  // namespace

std::vector<double> wall_volumes(const WallComplex& walls, std::size_t grains) {
  const std::vector<Vector3>& points = walls.points;
  // About a vertex of each grain, because cones from a distant point lose digits.
  std::vector<std::int32_t> origin(grains, -1);
  std::vector<double> sums(grains, 0.0);
  for (const WallTriangle& t : walls.triangles) {
    for (const std::int32_t grain : {t.inner, t.outer}) {
      if (grain < 0) continue;
      if (origin[grain] < 0) origin[grain] = t.corners[0];
      const Vector3& o = points[origin[grain]];
      const double six =
          six_volumes(points[t.corners[0]] - o, points[t.corners[1]] - o, points[t.corners[2]] - o);
      sums[grain] += grain == t.inner ? six : -six;
    }
  }
  for (double& sum : sums) sum /= 6.0;
  return sums;
}

double restore_volumes(WallComplex& walls, const std::vector<double>& volumes,
                       const std::vector<double>& shares) {
  std::vector<Vector3>& points = walls.points;
  const Groups at = faces_at_each(walls.triangles, points.size());
  std::vector<VolumeGradient> list;
  const auto gradients_at = [&](std::size_t v) {
    list.clear();
    double area = 0.0;
    for (const std::int32_t* k = at.begin(v); k != at.end(v); ++k) {
      const WallTriangle& t = walls.triangles[*k];
      const Vector3 normal =
          doubled_area_normal(points[t.corners[0]], points[t.corners[1]], points[t.corners[2]]);
      area += normal.norm() / 6.0;
      add_gradient(list, t.inner, normal / 6.0);
      if (t.outer >= 0) add_gradient(list, t.outer, -normal / 6.0);
    }
    return area;
  };
  double worst = 0.0;
  for (int step = 0; step < 20; ++step) {
    const std::vector<double> now = wall_volumes(walls, volumes.size());
    std::vector<double> missing(volumes.size(), 0.0);
    worst = 0.0;
    for (std::size_t g = 0; g < volumes.size(); ++g) {
      missing[g] = volumes[g] - now[g];
      worst = std::max(worst, std::abs(missing[g]) / volumes[g]);
    }
    if (worst < 1e-13) break;
    GrainMatrix matrix(volumes.size());
    for (std::size_t v = 0; v < points.size(); ++v) {
      const double area = gradients_at(v);
      if (!(area > 0.0)) continue;
      for (const VolumeGradient& a : list) {
        for (const VolumeGradient& b : list) {
          matrix.add(a.grain, b.grain, shares[v] * a.gradient.dot(b.gradient) / area);
        }
      }
    }
    std::vector<double> lengths = matrix.solve(missing);
    for (std::size_t g = 0; g < lengths.size(); ++g) {
      // A grain that is nearly flat asks for long moves, which turn its neighbours inside out.
      const double most = 0.1 * portable::cbrt(volumes[g]);
      lengths[g] = std::clamp(lengths[g], -most, most);
    }
    std::vector<Vector3> moved = points;
    for (std::size_t v = 0; v < points.size(); ++v) {
      const double area = gradients_at(v);
      if (!(area > 0.0)) continue;
      for (const VolumeGradient& one : list) {
        moved[v] += shares[v] * lengths[one.grain] / area * one.gradient;
      }
    }
    points = std::move(moved);
  }
  return worst;
}

DenseWalls::DenseWalls(WallComplex walls) : walls_(std::move(walls)) {
  find_places(walls_.triangles, faces_at_each(walls_.triangles, walls_.points.size()));
  find_normals();
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): the faces of voxels are freed at its end
DenseWalls::DenseWalls(VoxelWalls walls, int passes, const VolumeGeometry& geometry,
                       const Execution& execution) {
  {
    const Groups quads_at = faces_at_each(walls.quads, walls.corners.size());
    find_places(walls.quads, quads_at);
    smooth(walls, quads_at, passes, execution);
  }
  std::vector<Vector3>& points = walls_.points;
  for (Vector3& point : points) point = geometry.point(point);
  const bool is_left_handed = geometry.axes.determinant() < 0.0;  // faces are inside out
  walls_.triangles.reserve(2 * walls.quads.size());
  for (const WallQuad& quad : walls.quads) {
    std::array<std::int32_t, 4> c = quad.corners;
    if (is_left_handed) std::reverse(c.begin(), c.end());
    const auto length = [&](std::size_t a, std::size_t b) {
      return (points[c[a]] - points[c[b]]).squaredNorm();
    };
    if (length(0, 2) > length(1, 3)) std::rotate(c.begin(), c.begin() + 1, c.end());
    walls_.triangles.push_back({{c[0], c[1], c[2]}, quad.inner, quad.outer});
    walls_.triangles.push_back({{c[0], c[2], c[3]}, quad.inner, quad.outer});
  }
  find_normals();
}

void DenseWalls::find_normals() {
  const std::vector<Vector3>& points = walls_.points;
  triangles_at_ = faces_at_each(walls_.triangles, points.size());
  normals_.resize(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    Vector3 sum = Vector3::Zero();
    for (const std::int32_t* t = triangles_at_.begin(v); t != triangles_at_.end(v); ++t) {
      const auto& [a, b, c] = walls_.triangles[*t].corners;
      sum += doubled_area_normal(points[a], points[b], points[c]);
    }
    normals_[v] = sum.normalized().cast<float>();
  }
}

template <class Face>
void DenseWalls::find_places(const std::vector<Face>& faces, const Groups& faces_at) {
  const std::size_t count = faces_at.starts.size() - 1;
  places_.assign(count, WallPlace::Wall);
  line_of_.assign(count, -1);
  for (std::size_t v = 0; v < count; ++v) {
    // Most vertices have faces of one wall only.
    const Face& first = faces[*faces_at.begin(v)];
    const bool is_within = std::all_of(faces_at.begin(v), faces_at.end(v), [&](std::int32_t f) {
      return faces[f].inner == first.inner && faces[f].outer == first.outer;
    });
    if (is_within) continue;
    std::vector<std::int32_t> ends = line_ends(faces, faces_at, v);
    if (ends.empty()) continue;
    places_[v] = ends.size() == 2 ? WallPlace::Line : WallPlace::Point;
    line_of_[v] = static_cast<std::int32_t>(line_neighbours_.size());
    line_neighbours_.push_back(std::move(ends));
  }
}

bool DenseWalls::is_on_short_loop(std::size_t v) const {
  constexpr int most_steps = 16;
  if (places_[v] != WallPlace::Line) return false;
  auto before = static_cast<std::int32_t>(v);
  std::int32_t at = line_neighbours_[line_of_[v]][0];
  for (int step = 1; step < most_steps && places_[at] == WallPlace::Line; ++step) {
    const std::vector<std::int32_t>& ends = line_neighbours_[line_of_[at]];
    const std::int32_t next = ends[0] == before ? ends[1] : ends[0];
    if (index(next) == v) return true;
    before = at;
    at = next;
  }
  return false;
}

void DenseWalls::smooth(const VoxelWalls& walls, const Groups& quads_at, int passes,
                        const Execution& execution) {
  // Taubin's pass band of 0.1, as 1 / step + 1 / back = 0.1: slower variations stay.
  constexpr double step = 0.6307;
  constexpr double back = -0.6732;
  std::vector<Vector3> corners;
  corners.reserve(walls.corners.size());
  for (const VoxelCounts& c : walls.corners) corners.emplace_back(c[0], c[1], c[2]);
  walls_.points = corners;
  std::vector<Vector3> moved(corners.size());
  std::vector<bool> is_short(corners.size());
  for (std::size_t v = 0; v < corners.size(); ++v) is_short[v] = is_on_short_loop(v);
  const auto mean_at = [&](std::size_t v) {
    Vector3 sum = Vector3::Zero();
    if (line_of_[v] >= 0) {
      const std::vector<std::int32_t>& ends = line_neighbours_[line_of_[v]];
      for (const std::int32_t end : ends) sum += walls_.points[end];
      return Vector3(sum / static_cast<double>(ends.size()));
    }
    int count = 0;
    for (const std::int32_t* q = quads_at.begin(v); q != quads_at.end(v); ++q) {
      const auto& c = walls.quads[*q].corners;
      const auto k = static_cast<std::size_t>(
          std::find(c.begin(), c.end(), static_cast<std::int32_t>(v)) - c.begin());
      sum += walls_.points[c[(k + 1) % 4]] + walls_.points[c[(k + 3) % 4]];
      count += 2;
    }
    return Vector3(sum / count);
  };
  for (int pass = 0; pass < passes; ++pass) {
    execution.report(static_cast<double>(pass) / passes, "Smoothing the walls");
    for (const double factor : {step, back}) {
      execution.parallel_for_each(corners.size(), smoothing_block, [&](std::size_t v) {
        // A line has larger steps: it jumps where the steps of its walls meet. The line about
        // a wall of few faces would shrink to a point.
        const double most = places_[v] != WallPlace::Line ? 0.5 : is_short[v] ? 0.2 : 0.75;
        const Vector3 to = walls_.points[v] + factor * (mean_at(v) - walls_.points[v]) - corners[v];
        moved[v] = corners[v] + to.cwiseMax(-most).cwiseMin(most);
      });
      walls_.points.swap(moved);
    }
  }
}

WallPoint DenseWalls::nearest_on_wall(std::int32_t from, const Vector3& target, std::int32_t inner,
                                      std::int32_t outer) const {
  const auto visit_corners = [&](std::int32_t vertex, const auto& visit) {
    for (const std::int32_t* t = triangles_at_.begin(index(vertex));
         t != triangles_at_.end(index(vertex)); ++t) {
      const WallTriangle& triangle = walls_.triangles[*t];
      if (triangle.inner == inner && triangle.outer == outer) visit(triangle.corners);
    }
  };
  std::int32_t best = from;
  double distance = (walls_.points[from] - target).squaredNorm();
  for (std::int32_t at = -1; at != best;) {
    at = best;
    visit_corners(at, [&](const Triangle& corners) {
      for (const std::int32_t corner : corners) {
        const double d = (walls_.points[corner] - target).squaredNorm();
        if (d >= distance) continue;
        distance = d;
        best = corner;
      }
    });
  }
  WallPoint result{walls_.points[best], best};
  visit_corners(best, [&](const Triangle& c) {
    const Vector3& p = walls_.points[c[0]];
    const Vector3& q = walls_.points[c[1]];
    const Vector3& r = walls_.points[c[2]];
    const Vector3 w = nearest_weights(p, q, r, target);
    const Vector3 near = w[0] * p + w[1] * q + w[2] * r;
    const double d = (near - target).squaredNorm();
    if (!(d < distance)) return;  // not a number for triangles without area
    distance = d;
    result.point = near;
  });
  return result;
}

WallPoint DenseWalls::nearest_on_line(std::int32_t from, const Vector3& target) const {
  std::int32_t best = from;
  double distance = (walls_.points[from] - target).squaredNorm();
  for (std::int32_t at = -1; at != best;) {
    at = best;
    for (const std::int32_t end : line_neighbours_[line_of_[at]]) {
      const double d = (walls_.points[end] - target).squaredNorm();
      if (d >= distance || places_[end] != WallPlace::Line) continue;
      distance = d;
      best = end;
    }
  }
  WallPoint result{walls_.points[best], best};
  for (const std::int32_t end : line_neighbours_[line_of_[best]]) {
    const Vector3 along = walls_.points[end] - walls_.points[best];
    const double square = along.squaredNorm();
    if (!(square > 0.0)) continue;
    const double share = std::clamp(along.dot(target - walls_.points[best]) / square, 0.0, 1.0);
    const Vector3 near = walls_.points[best] + share * along;
    const double d = (near - target).squaredNorm();
    if (!(d < distance)) continue;
    distance = d;
    result.point = near;
  }
  return result;
}

}  // namespace wscvt
