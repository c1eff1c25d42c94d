// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

#include "toolbox/volume/segmentation.h"
#include "toolbox/volume/segmentation_steps.h"

namespace wscvt {

namespace {

/// Voxels of middle values, and those at either end of the grey values.
struct GreyEdges {
  std::uint64_t middle = 0;         ///< voxels in the middle tenth of the range
  std::uint64_t inside_middle = 0;  ///< those with all neighbours there: no edge
  /// With all neighbours by faces at the least, and at the largest value.
  std::array<std::uint64_t, 2> flat{};
  std::array<std::uint64_t, 2> specks{};  ///< of these, those that are not: noise on one side
};

/// Values on either side of the middle one that are a tenth of the range.
int band_of(int least, int largest) { return std::max(1, (largest - least) / 20); }

/// Visits all voxels that were scanned, as their neighbours were.
GreyEdges edges_of(const std::vector<std::uint16_t>& grey, const std::vector<std::uint8_t>& outside,
                   const VoxelCounts& sizes, int least, int largest) {
  constexpr double noise = 0.01;  // of the range; and more than rounding
  const int margin = std::max(2, static_cast<int>(noise * (largest - least)));
  const int middle = (least + largest) / 2;
  const int band = band_of(least, largest);
  GreyEdges edges;
  const auto [next_x, width, slice] = VoxelGrid(sizes).steps;
  const auto is_outside = [&](std::size_t voxel) { return is_marked(outside, voxel); };
  for (std::size_t k = slice; k + slice < grey.size(); ++k) {
    const std::size_t in_slice = k % slice;
    const std::size_t x = in_slice % width;
    if (x == 0 || x + 1 == width || in_slice < width || in_slice + width >= slice) continue;
    const std::array<std::size_t, 6> beside = {k + next_x, k + width, k + slice,
                                               k - slice,  k - width, k - next_x};
    if (is_outside(k) || std::any_of(beside.begin(), beside.end(), is_outside)) continue;
    const int here = grey[k];
    int darkest = grey[beside[0]];
    int brightest = darkest;
    for (const std::size_t voxel : beside) {
      darkest = std::min<int>(darkest, grey[voxel]);
      brightest = std::max<int>(brightest, grey[voxel]);
    }
    if (std::abs(here - middle) <= band) {
      ++edges.middle;
      if (darkest >= middle - band && brightest <= middle + band) ++edges.inside_middle;
    }
    if (darkest != brightest || (darkest != least && darkest != largest)) continue;
    const std::size_t end = darkest == largest ? 1 : 0;
    ++edges.flat[end];
    if (std::abs(here - darkest) >= margin) ++edges.specks[end];
  }
  return edges;
}

}  // namespace

CutOffGreys cut_off_greys(const std::vector<std::uint16_t>& grey,
                          const std::vector<std::uint8_t>& outside, const VoxelCounts& sizes) {
  const std::vector<std::uint64_t> counts = counts_of_all(grey, outside);
  CutOffGreys found;
  const auto least = static_cast<int>(quantile_of(counts, 0.0));
  const auto largest = static_cast<int>(quantile_of(counts, 1.0));
  if (least == largest) return found;
  const auto parted = static_cast<int>(otsu_level(counts));
  const auto sum = [&](int begin, int end) {
    return static_cast<double>(std::accumulate(
        counts.begin() + begin, counts.begin() + std::max(begin, end), std::uint64_t{0}));
  };
  const GreyEdges edges = edges_of(grey, outside, sizes, least, largest);
  const auto middle = static_cast<double>(edges.middle);
  // Labels have voxels of middle values inside of bodies.
  constexpr double few_middle = 50.0;
  found.has_edges =
      middle >= few_middle && static_cast<double>(edges.inside_middle) <= 0.1 * middle;
  if (!found.has_edges) return found;
  // Edges of a blurred scan have each value in the tenth beside a phase 3 and more times as often
  // as those in the middle one.
  constexpr double times = 2.2;
  const int tenth = (largest - least) / 10;
  const bool are_fine = tenth > 1 && middle >= 200.0;
  const double most_near = times * middle * static_cast<double>(tenth - 1) /
                           static_cast<double>(2 * band_of(least, largest) + 1);
  std::array<double, 2> fractions{};
  bool is_cut_off = false;
  for (const std::size_t k : {0U, 1U}) {
    const int end = k == 0 ? least : largest;
    const double all = k == 0 ? sum(least, parted) : sum(parted, largest + 1);
    fractions[k] = static_cast<double>(counts[static_cast<std::size_t>(end)]) / all;
    constexpr double many = 0.2;
    if (fractions[k] <= many) {
      fractions[k] = 0.0;
      continue;
    }
    const double near = k == 0 ? sum(least + 1, least + tenth) : sum(largest - tenth + 1, largest);
    const bool ends_at_once = are_fine && near < most_near;
    const auto specks = static_cast<double>(edges.specks[k]);
    const bool has_noise = specks >= 20.0 && specks > 0.001 * static_cast<double>(edges.flat[k]);
    is_cut_off = is_cut_off || has_noise || ends_at_once;
  }
  // Where one end was cut off, so was the other, if it has as many values.
  if (is_cut_off) {
    found.least = fractions[0];
    found.largest = fractions[1];
  }
  return found;
}

}  // namespace wscvt
