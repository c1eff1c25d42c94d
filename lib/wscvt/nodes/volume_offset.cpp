// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/volume_offset.h"

#include <cmath>
#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

double offset_to_volume(std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                        double volume) {
  // Newton's method; each step squares what is missing, of a large offset after some.
  constexpr int most_steps = 30;
  constexpr double rounding = 1e-15;
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
    if (!(slope > 0.0)) break;
    const double missing =
        volume - mesh_sums(points, triangles, Vector3::Zero(), Execution(1)).volume();
    if (std::abs(missing) <= rounding * std::abs(volume)) break;
    const double distance = missing / slope;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double length = gradient[i].norm();
      if (length > 0.0) points[i] += distance / length * gradient[i];
    }
    offset += distance;
  }
  return offset;
}

}  // namespace wscvt
