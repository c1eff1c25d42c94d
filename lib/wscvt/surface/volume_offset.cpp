// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/volume_offset.h"

#include <cmath>
#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

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
