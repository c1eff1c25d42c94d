// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "toolbox/resolution/mesh_voxels.h"
#include "toolbox/volume/open_volume.h"
#include "toolbox/volume/segmentation.h"
#include "wscvt/base/numbers.h"

namespace wscvt::test {

/// Averages grey values with a Gaussian along an axis, whose neighbours are `step` apart.
inline void blur_along(std::vector<float>& grey, std::size_t count, std::size_t step,
                       double deviation) {
  const auto reach = static_cast<int>(std::ceil(4.0 * deviation));
  std::vector<double> weights;
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (deviation * deviation)));
    sum += weights.back();
  }
  std::vector<double> line(count);
  for (std::size_t first = 0; first < grey.size(); ++first) {
    if (first / step % count != 0) continue;
    for (std::size_t k = 0; k < count; ++k) line[k] = grey[first + k * step];
    for (std::size_t k = 0; k < count; ++k) {
      double value = 0.0;
      for (int away = -reach; away <= reach; ++away) {
        const auto place = static_cast<std::ptrdiff_t>(k) + away;
        if (place < 0 || place >= static_cast<std::ptrdiff_t>(count)) continue;
        value +=
            weights[static_cast<std::size_t>(away + reach)] * line[static_cast<std::size_t>(place)];
      }
      grey[first + k * step] = static_cast<float>(value / sum);
    }
  }
}

/// A scan: what part of each voxel is inside, blurred, with noise.
struct Scan {
  double blur = 0.0;   ///< a standard deviation, voxels; 0: exact labels
  double noise = 0.0;  ///< a standard deviation; the step from void to grain is 1
};

/// Returns the voxels of the largest grain that `segment` finds in the scan of a body.
inline std::vector<VoxelStretch> segmented_voxels(const IndexedMesh& mesh, double size,
                                                  VoxelPose at, const Scan& scan,
                                                  std::mt19937_64& numbers) {
  const auto uniform = [&] {
    return std::ldexp(static_cast<double>(numbers() >> 11U) + 0.5, -53);  // in (0, 1)
  };
  constexpr int parts = 3;  // of a voxel's edge
  constexpr double margin = 7.0;
  at.shift = parts * (at.shift + Vector3::Constant(margin));
  const std::vector<VoxelStretch> fine = mesh_voxels(mesh, size / parts, at);
  std::array<std::int64_t, 3> counts{};  // z, y, x
  for (const VoxelStretch& one : fine) {
    counts[0] = std::max<std::int64_t>(counts[0], one.z / parts);
    counts[1] = std::max<std::int64_t>(counts[1], one.y / parts);
    counts[2] = std::max<std::int64_t>(counts[2], one.end / parts);
  }
  for (std::int64_t& count : counts) count += 2 + static_cast<std::int64_t>(margin);
  const auto width = static_cast<std::size_t>(counts[2]);
  const std::size_t slice = width * static_cast<std::size_t>(counts[1]);
  std::vector<float> grey(slice * static_cast<std::size_t>(counts[0]), 0.0F);
  for (const VoxelStretch& one : fine) {
    for (std::int32_t x = one.begin; x < one.end; ++x) {
      grey[static_cast<std::size_t>(one.z / parts) * slice +
           static_cast<std::size_t>(one.y / parts) * width + static_cast<std::size_t>(x / parts)] +=
          1.0F / (parts * parts * parts);
    }
  }
  blur_along(grey, width, 1, scan.blur);
  blur_along(grey, static_cast<std::size_t>(counts[1]), width, scan.blur);
  blur_along(grey, static_cast<std::size_t>(counts[0]), slice, scan.blur);
  for (float& value : grey) {
    // Box and Muller
    const double length = std::sqrt(-2.0 * std::log(uniform()));
    value += static_cast<float>(scan.noise * length * std::cos(2.0 * pi * uniform()));
  }
  const auto volume =
      open_array({grey.data(), "<f4", {counts[0], counts[1], counts[2]}}, {}, "scan");
  SegmentationOptions options;
  options.separate = 0.0;
  const Segmentation found = segment(*volume, options, Execution(1));
  const auto largest =
      std::max_element(found.grains.begin(), found.grains.end(),
                       [](const auto& a, const auto& b) { return a.voxels < b.voxels; });
  std::vector<VoxelStretch> voxels;
  found.labels->rewind();
  for (std::int32_t z = 0; z < counts[0]; ++z) {
    for (std::int32_t y = 0; y < counts[1]; ++y) {
      const std::vector<Label>& row = found.labels->next_row();
      for (std::int32_t x = 0; x < counts[2]; ++x) {
        if (row[static_cast<std::size_t>(x)] != largest->label) continue;
        if (voxels.empty() || voxels.back().z != z || voxels.back().y != y ||
            voxels.back().end != x) {
          voxels.push_back({z, y, x, x});
        }
        ++voxels.back().end;
      }
    }
  }
  return voxels;
}

}  // namespace wscvt::test
