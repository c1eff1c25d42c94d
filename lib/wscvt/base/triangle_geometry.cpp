// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

MeshSums mesh_sums(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                   const Vector3& origin, const Execution& execution) {
  return execution.parallel_sum_of(
      triangles.size(), usual_block, MeshSums(), [&](std::size_t f, MeshSums& part) {
        const auto& [a, b, c] = triangles[f];
        part.add(points[a] - origin, points[b] - origin, points[c] - origin);
      });
}

double volume_of(const IndexedMesh& mesh, const Execution& execution) {
  const Vector3& origin = mesh.points[mesh.triangles[0][0]];
  return mesh_sums(mesh.points, mesh.triangles, origin, execution).volume();
}

std::vector<Vector3> vertex_normals(const std::vector<Vector3>& points,
                                    const std::vector<Triangle>& triangles) {
  std::vector<Vector3> normals(points.size(), Vector3::Zero());
  for (const Triangle& t : triangles) {
    const Vector3 normal = doubled_area_normal(points[t[0]], points[t[1]], points[t[2]]);
    for (const std::int32_t v : t) normals[v] += normal;
  }
  for (Vector3& normal : normals) {
    const double length = normal.norm();
    if (length > 0.0) normal /= length;
  }
  return normals;
}

std::vector<double> vertex_areas(const IndexedMesh& mesh) {
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const double third = triangle_area(mesh, t) / 3.0;
    for (const std::int32_t v : t) areas[v] += third;
  }
  return areas;
}

Eigen::AlignedBox3d box_of(const std::vector<Vector3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : points) box.extend(p);
  return box;
}

Eigen::AlignedBox3d box_of_faces(const IndexedMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  Vector3 low = mesh.points[mesh.triangles[0][0]];
  Vector3 high = low;
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) {
      low = low.cwiseMin(mesh.points[v]);
      high = high.cwiseMax(mesh.points[v]);
    }
  }
  return {low, high};
}

Vector3 nearest_weights(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p) {
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 / (d1 - d3);
    return {1.0 - v, v, 0.0};
  }
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return {1.0 - w, 0.0, w};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

double largest_corner_cosine(const Vector3& a, const Vector3& b, const Vector3& c) {
  const std::array<Vector3, 3> sides{b - a, c - b, a - c};
  double largest = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3& out = sides[k];
    const Vector3& in = sides[(k + 2) % 3];
    const double lengths = out.norm() * in.norm();
    largest = std::max(largest, lengths > 0.0 ? -out.dot(in) / lengths : 1.0);
  }
  return largest;
}

double sampled_mean_edge(const IndexedMesh& mesh) {
  constexpr std::size_t most = 10000;
  const std::size_t stride = 1 + mesh.triangles.size() / most;
  double sum = 0.0;
  double edges = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); f += stride) {
    const Triangle& t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      sum += (mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]).norm();
      edges += 1.0;
    }
  }
  return edges > 0.0 ? sum / edges : 0.0;
}

double single_precision_step(const IndexedMesh& mesh) {
  const double edge = sampled_mean_edge(mesh);
  if (!(edge > 0.0) || !std::isfinite(edge)) return 0.0;
  double largest = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) {
      largest = std::max(largest, mesh.points[v].cwiseAbs().maxCoeff());
    }
  }
  // Floats have 24 binary digits.
  return std::ldexp(1.0, std::ilogb(largest) - 23) / edge;
}

namespace {

/// Longest offset, in cube roots of the volume. If a mesh is far from the volume, its parallel
/// surfaces fold over before they enclose it.
constexpr double farthest_offset = 0.1;

MeshSums sums_of(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles) {
  return mesh_sums(points, triangles, Vector3::Zero(), Execution(1));
}

/// Scales about the centroid; returns the mean displacement.
double scale_to_volume(std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                       double volume) {
  const MeshSums sums = sums_of(points, triangles);
  if (!(sums.volume() > 0.0)) return 0.0;
  const double factor = portable::cbrt(volume / sums.volume());
  const Vector3 centroid = sums.centroid();
  double distances = 0.0;
  for (Vector3& point : points) {
    distances += (point - centroid).norm();
    point = centroid + factor * (point - centroid);
  }
  return (factor - 1.0) * distances / static_cast<double>(points.size());
}

}  // namespace

double offset_to_volume(std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                        double volume) {
  // Newton's method: each step squares the relative error, after a few steps of a large offset.
  constexpr int most_steps = 30;
  constexpr double rounding = 1e-15;
  const std::vector<Vector3> start = points;
  const double farthest = farthest_offset * portable::cbrt(volume);
  double offset = 0.0;
  std::vector<Vector3> gradient(points.size());
  for (int step = 0; step < most_steps; ++step) {
    gradient.assign(points.size(), Vector3::Zero());
    for (const auto& [a, b, c] : triangles) {
      const Vector3 third = doubled_area_normal(points[a], points[b], points[c]) / 6.0;
      gradient[a] += third;
      gradient[b] += third;
      gradient[c] += third;
    }
    double slope = 0.0;
    for (const Vector3& g : gradient) slope += g.norm();
    const double missing = volume - sums_of(points, triangles).volume();
    if (std::abs(missing) <= rounding * std::abs(volume)) break;
    const double distance = missing / slope;
    offset += distance;
    if (!(std::abs(offset) <= farthest)) {
      points = start;
      return scale_to_volume(points, triangles, volume);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double length = gradient[i].norm();
      if (length > 0.0) points[i] += distance / length * gradient[i];
    }
  }
  return offset;
}

}  // namespace wscvt
