// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_samples.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "wscvt/measures/distances.h"

namespace wscvt {

namespace {

/// A triangle has three unknown heights; ten samples for each of these leave its plane to the
/// surface and not to where the samples happen to lie.
constexpr std::size_t samples_per_triangle = 32;
/// Few nodes stand for large parts of the original, whose detail a few samples would miss.
constexpr std::size_t smallest_sample_count = 50000;
/// 24 bytes a point and 4 in a list: a quarter of a gigabyte. On so many triangles that this leaves
/// less than four samples each, four are taken all the same, one more than determine a plane.
constexpr std::size_t largest_sample_count = 8000000;
constexpr std::size_t least_samples_per_triangle = 4;

/// The triangle whose cone from the origin holds the sample, by a walk from `start`: each step
/// leaves through the edge that the sample is farthest outside of.
std::int32_t locate(const std::vector<Vector3>& positions, const SphereTriangulation& triangulation,
                    const Vector3& sample, std::int32_t start) {
  const std::vector<Triangle>& triangles = triangulation.triangles();
  const auto side = [&](std::int32_t t, std::int32_t k) {
    return positions[triangles[t][k]].cross(positions[triangles[t][(k + 1) % 3]]).dot(sample);
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

std::vector<Vector3> visible_samples(const MeshSurface& original, std::size_t triangles,
                                     const Execution& execution) {
  const std::size_t wanted =
      std::clamp(samples_per_triangle * triangles, smallest_sample_count,
                 std::max(largest_sample_count, least_samples_per_triangle * triangles));
  std::vector<Vector3> samples = area_uniform_samples(original.mesh(), wanted);
  std::vector<Vector3> directions(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) directions[i] = samples[i].normalized();
  const std::vector<double> radii = original.radii(directions, execution);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // A star-shaped mesh cannot follow two sheets in one direction: those behind the outermost
    // would draw it between the two. The ray's hit and the sample are the same point of the same
    // face up to rounding, some 1e-16 of the radius over the cosine of the face's tilt.
    if (samples[i].norm() > (1.0 - 1e-9) * radii[i]) samples[kept++] = samples[i];
  }
  samples.resize(kept);
  return samples;
}

std::vector<SampleList> samples_of_triangles(const std::vector<Vector3>& positions,
                                             const SphereTriangulation& triangulation,
                                             const std::vector<Vector3>& samples,
                                             const Execution& execution) {
  constexpr std::size_t block = 1024;
  std::vector<std::int32_t> triangle_of(samples.size());
  execution.parallel_for(samples.size(), block, [&](std::size_t begin, std::size_t end) {
    // Samples come face by face of the original, so that each lies near the one before it.
    std::int32_t t = 0;
    for (std::size_t s = begin; s < end; ++s) {
      t = locate(positions, triangulation, samples[s], t);
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
