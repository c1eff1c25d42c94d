// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "toolbox/volume/segmentation_steps.h"
#include "wscvt/base/numbers.h"

namespace wscvt {

namespace {

/// Grey values between the phases beside a level: a phase that is brighter than the material beside
/// it must not push the surface outwards.
struct Clamped {
  std::int32_t least;
  std::int32_t most;
  std::int32_t operator()(std::uint16_t grey) const {
    return std::clamp(std::int32_t{grey}, least, most);
  }
};

Clamped clamped_at(const GreyLevel& level) {
  const double half = 0.5 * level.contrast;
  return {static_cast<std::int32_t>(std::ceil(level.value - half)),
          static_cast<std::int32_t>(std::floor(level.value + half))};
}

/// Returns the sums over each voxel and its 26 neighbours; beyond the border, the border's values.
std::vector<std::uint32_t> sums_of(const std::vector<std::uint16_t>& grey,
                                   const VoxelCounts& counts, const Clamped& clamped,
                                   const Execution& execution) {
  const VoxelGrid grid(counts);
  const std::size_t width = grid.sizes[0];
  const std::size_t slices = grid.sizes[2];
  const std::size_t slice = grid.steps[2];
  std::vector<std::uint32_t> flat(grey.size());
  execution.parallel_for(slices, 1, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> lines(slice);
    for (std::size_t z = begin; z < end; ++z) {
      for (std::size_t k = 0; k < slice; ++k) {
        const std::size_t x = k % width;
        const std::uint16_t* const here = grey.data() + z * slice + k;
        lines[k] =
            static_cast<std::uint32_t>(clamped(x > 0 ? here[-1] : here[0]) + clamped(here[0]) +
                                       clamped(x + 1 < width ? here[1] : here[0]));
      }
      for (std::size_t k = 0; k < slice; ++k) {
        flat[z * slice + k] =
            lines[k < width ? k : k - width] + lines[k] + lines[k + width < slice ? k + width : k];
      }
    }
  });
  std::vector<std::uint32_t> sums(grey.size());
  execution.parallel_for(slices, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * slice; k < end * slice; ++k) {
      sums[k] =
          flat[k < slice ? k : k - slice] + flat[k] + flat[k + slice < flat.size() ? k + slice : k];
    }
  });
  return sums;
}

}  // namespace

double blur_at(const std::vector<std::uint16_t>& grey, const std::vector<std::uint8_t>& outside,
               const VoxelCounts& counts, const GreyLevel& level) {
  const Clamped clamped = clamped_at(level);
  std::uint64_t sum = 0;
  std::uint64_t pairs = 0;
  for_each_pair(counts, [&](std::size_t a, std::size_t b) {
    if ((grey[a] < level.value) == (grey[b] < level.value)) return;
    if (is_marked(outside, a) || is_marked(outside, b)) return;
    sum += static_cast<std::uint64_t>(std::abs(clamped(grey[a]) - clamped(grey[b])));
    ++pairs;
  });
  if (pairs == 0 || sum == 0) return 0.0;
  // By tenths of a voxel of a Gaussian blur s: the mean difference over all places and directions
  // of an edge, 4 times the integral of (1 - v) (Phi(v / s) - 1 / 2) over v from 0 to 1.
  constexpr std::array<double, 16> differences = {1.0,    0.8504, 0.7208, 0.6113, 0.5213, 0.4492,
                                                  0.3919, 0.3461, 0.3091, 0.2788, 0.2536, 0.2323,
                                                  0.2143, 0.1988, 0.1853, 0.1735};
  const double difference =
      static_cast<double>(sum) / static_cast<double>(pairs) / (clamped.most - clamped.least);
  // Beyond the table, an edge is straight within a voxel.
  if (difference < differences.back()) return 2.0 / (3.0 * std::sqrt(2.0 * pi) * difference);
  std::size_t above = 1;
  while (above + 1 < differences.size() && differences[above] > difference) ++above;
  const double share =
      (differences[above - 1] - difference) / (differences[above - 1] - differences[above]);
  return 0.1 * (static_cast<double>(above - 1) + std::clamp(share, 0.0, 1.0));
}

std::vector<std::uint8_t> level_mask(const std::vector<std::uint16_t>& grey,
                                     const std::vector<std::uint8_t>& outside,
                                     const VoxelCounts& counts, const GreyLevel& level,
                                     const Execution& execution) {
  std::vector<std::uint8_t> mask(grey.size());
  const Clamped clamped = clamped_at(level);
  if (clamped.least >= clamped.most) {
    for (std::size_t k = 0; k < grey.size(); ++k) {
      const bool is_material = level.is_dark ? grey[k] <= level.value : grey[k] >= level.value;
      mask[k] = is_material && !is_marked(outside, k) ? 1 : 0;
    }
    return mask;
  }
  // An edge that a blur of variance s has moved moves back by s times the Laplacian. The steps of
  // voxels take a little more, which was measured on balls and ellipsoids.
  constexpr double steps = 1.3;
  constexpr double of_three = 2.0 / 3.0;  // variance of a median, and of the mean
  const double blur = std::min(blur_at(grey, outside, counts, level), largest_blur);
  const double back = steps * (blur * blur + (level.medians + 1) * of_three);
  const std::vector<std::uint32_t> sums = sums_of(grey, counts, clamped, execution);
  constexpr double voxels = 27.0;
  const double at = voxels * level.value;
  const auto is_material = [&](double sum) { return level.is_dark ? sum <= at : sum >= at; };
  const VoxelGrid grid(counts);
  const std::size_t slice = grid.steps[2];
  execution.parallel_for(grid.sizes[2], 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * slice; k < end * slice; ++k) {
      const bool is_in = is_material(sums[k]);
      bool is_beside = false;
      double laplacian = 0.0;
      for_each_neighbour(k, counts, [&](std::size_t other) {
        is_beside = is_beside || is_material(sums[other]) != is_in;
        laplacian += static_cast<double>(sums[other]) - static_cast<double>(sums[k]);
      });
      const bool is_taken = is_beside ? is_material(sums[k] - back * laplacian) : is_in;
      mask[k] = is_taken && !is_marked(outside, k) ? 1 : 0;
    }
  });
  return mask;
}

}  // namespace wscvt
