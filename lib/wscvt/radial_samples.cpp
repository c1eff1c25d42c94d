// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/radial_samples.h"

#include <cmath>

#include "wscvt/solid_angle.h"

namespace wscvt {

RadialSamples radial_samples(const IndexedMesh& mesh, const Execution& execution) {
  constexpr std::size_t block_size = 4096;
  const std::size_t count = mesh.points.size();
  RadialSamples samples;
  samples.directions.resize(count);
  samples.radii.resize(count);
  samples.weights.assign(count, 0.0);
  samples.vertices.resize(count);
  execution.parallel_for(count, block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      samples.radii[i] = mesh.points[i].norm();
      samples.directions[i] = mesh.points[i] / samples.radii[i];
      samples.vertices[i] = static_cast<std::int32_t>(i);
    }
  });
  for (const Triangle& t : mesh.triangles) {
    const double third = std::abs(solid_angle(samples.directions[t[0]], samples.directions[t[1]],
                                              samples.directions[t[2]])) /
                         3.0;
    for (const std::int32_t v : t) samples.weights[v] += third;
  }
  return samples;
}

}  // namespace wscvt
