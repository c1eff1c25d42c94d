// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "grains/bent_grain.h"
#include "support/random_harmonics.h"
#include "support/test_shapes.h"
#include "toolbox/sample/sample_grain.h"
#include "wscvt/base/error.h"

namespace wscvt::test {

/// Grains of one population: long and flat to different degrees, rough, of different sizes.
inline std::vector<HarmonicSurface> random_surfaces(int count, int degree, std::uint64_t seed) {
  std::vector<HarmonicSurface> surfaces;
  for (int k = 0; k < count; ++k) {
    std::vector<double> c = random_harmonics(degree, 1000 * seed + static_cast<std::uint64_t>(k));
    const double size = 1.0 + 3.0 * std::abs(c[1]);
    for (std::size_t i = 4; i < 9; ++i) c[i] *= 7.0;
    for (std::size_t i = 9; i < c.size(); ++i) c[i] *= 2.5;
    for (double& value : c) value *= size;
    surfaces.emplace_back(c);
  }
  return surfaces;
}

inline std::vector<SampleGrain> random_sample(int count, const SampleGrids& grids,
                                              std::uint64_t seed) {
  std::vector<SampleGrain> sample;
  for (const HarmonicSurface& surface : random_surfaces(count, grids.degree(), seed)) {
    sample.push_back(sample_grain(surface, grids, Execution(1)));
  }
  return sample;
}

/// Crescents and C-shapes of other proportions, and two star-shaped grains.
inline std::vector<SampleGrain> bent_sample(const SampleGrids& grids) {
  std::vector<SampleGrain> sample = random_sample(2, grids, 8);
  for (const char* name : {"crescent", "C-shape"}) {
    const IndexedMesh mesh = bent_grain_mesh(bent_grain(name), 900);
    for (const Vector3& stretch : {Vector3(1.0, 1.0, 1.0), Vector3(1.3, 1.1, 0.8),
                                   Vector3(0.9, 1.2, 1.1), Vector3(1.1, 0.9, 1.3)}) {
      sample.push_back(sample_grain(scaled(mesh, stretch), grids, Execution(1)));
    }
  }
  return sample;
}

}  // namespace wscvt::test
