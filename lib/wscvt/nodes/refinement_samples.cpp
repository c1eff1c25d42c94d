// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_samples.h"

#include <Eigen/Geometry>
#include <cstddef>

namespace wscvt {

namespace {

/// The triangle whose cone on the sphere holds the direction, by a walk from `start`: each step
/// leaves through the edge that it is farthest outside of.
std::int32_t locate(const std::vector<RefinementNode>& nodes,
                    const SphereTriangulation& triangulation, const Vector3& direction,
                    std::int32_t start) {
  const std::vector<Triangle>& triangles = triangulation.triangles();
  const auto side = [&](std::int32_t t, std::int32_t k) {
    return nodes[triangles[t][k]]
        .direction.cross(nodes[triangles[t][(k + 1) % 3]].direction)
        .dot(direction);
  };
  std::int32_t t = start;
  // The walk ends on a Delaunay triangulation (Devillers, Pion and Teillaud 2002); this one is
  // Delaunay on the surface, if at all, and on others it might go round in circles.
  for (std::size_t step = 0; step < 2 * triangles.size(); ++step) {
    double worst = 0.0;
    std::int32_t leave = -1;
    for (std::int32_t k = 0; k < 3; ++k) {
      const double inside = side(t, k);
      if (inside < worst) {
        worst = inside;
        leave = 3 * t + k;
      }
    }
    if (leave < 0) return t;
    t = triangulation.opposite()[leave] / 3;
  }
  for (t = 0; t < static_cast<std::int32_t>(triangles.size()); ++t) {
    if (side(t, 0) >= 0.0 && side(t, 1) >= 0.0 && side(t, 2) >= 0.0) return t;
  }
  // On an edge, and by rounding outside of both its triangles: any triangle will do for one sample.
  return start;
}

}  // namespace

std::vector<SampleList> samples_of_triangles(const std::vector<RefinementNode>& nodes,
                                             const SphereTriangulation& triangulation,
                                             const RefinementSamples& samples,
                                             const Execution& execution) {
  constexpr std::size_t block = 1024;
  std::vector<std::int32_t> triangle_of(samples.size());
  execution.parallel_for(samples.size(), block, [&](std::size_t begin, std::size_t end) {
    // Samples come face by face of the original, so that each lies near the one before it.
    std::int32_t t = 0;
    for (std::size_t s = begin; s < end; ++s) {
      t = locate(nodes, triangulation, samples.direction(s), t);
      triangle_of[s] = t;
    }
  });
  std::vector<SampleList> lists(triangulation.triangles().size());
  for (std::size_t s = 0; s < triangle_of.size(); ++s) {
    lists[triangle_of[s]].push_back(static_cast<std::int32_t>(s));
  }
  return lists;
}

}  // namespace wscvt
