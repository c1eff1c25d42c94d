// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/medial_spheres.h"

#include <utility>

#include "toolbox/clump/point_blocks.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

namespace {

Sphere shrunk(const SurfaceSample& sample, const PointBlocks& blocks, double largest) {
  constexpr int most_steps = 30;
  constexpr double tolerance = 1e-6;
  double radius = largest;
  for (int step = 0; step < most_steps; ++step) {
    const Vector3 centre = sample.point - radius * sample.normal;
    const Vector3& nearest = blocks.points()[blocks.nearest(centre)];
    // The sample itself is nearest, or a point equally near.
    if ((nearest - centre).norm() >= radius * (1.0 - tolerance)) break;
    const Vector3 chord = sample.point - nearest;
    const double reach = sample.normal.dot(chord);
    if (!(reach > 0.0)) break;
    const double next = 0.5 * chord.squaredNorm() / reach;
    if (!(next < radius)) break;
    radius = next;
  }
  return {sample.point - radius * sample.normal, radius};
}

}  // namespace

std::vector<SurfaceSample> surface_samples(const IndexedMesh& mesh, std::size_t count) {
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  for (const MeshPlace& place : area_uniform_places(mesh, count)) {
    const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(place.triangle)];
    const Vector3 normal = doubled_area_normal(mesh.points[a], mesh.points[b], mesh.points[c]);
    samples.push_back({point_at(mesh, place), normal.normalized()});
  }
  return samples;
}

std::vector<Sphere> medial_spheres(const std::vector<SurfaceSample>& samples, std::size_t step,
                                   double largest, const Execution& execution) {
  constexpr std::size_t block = 32;
  std::vector<Vector3> points;
  points.reserve(samples.size());
  for (const SurfaceSample& sample : samples) points.push_back(sample.point);
  const PointBlocks blocks(std::move(points));
  std::vector<Sphere> spheres((samples.size() + step - 1) / step);
  execution.parallel_for(spheres.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      spheres[i] = shrunk(samples[i * step], blocks, largest);
    }
  });
  return spheres;
}

}  // namespace wscvt
