// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

#include "toolbox/volume/segmentation.h"
#include "toolbox/volume/segmentation_steps.h"

namespace wscvt {

namespace {

/// Voxels of the darker or the brighter side.
struct GreySide {
  std::uint64_t inner = 0;   ///< with all neighbours by faces on the same side
  std::uint64_t peaks = 0;   ///< of the inner ones, darker or brighter than all neighbours: noise
  std::uint64_t flat = 0;    ///< with all neighbours at the end of the range
  std::uint64_t specks = 0;  ///< of these, those that are not at the end: noise on one side
};

/// The two sides, and the edges between them.
struct GreyEdges {
  std::array<GreySide, 2> sides;
  std::uint64_t middle = 0;         ///< voxels in the middle tenth of the range
  std::uint64_t inside_middle = 0;  ///< those with all neighbours there: no edge
  std::uint64_t crossings = 0;      ///< pairs of neighbours on two sides of the middle
};

/// Visits all voxels that were scanned, as their neighbours were. `parted`: the least grey value of
/// the brighter side.
GreyEdges edges_of(const std::vector<std::uint16_t>& grey, const std::vector<std::uint8_t>& outside,
                   const VoxelCounts& sizes, int parted, int least, int largest) {
  constexpr double noise = 0.01;  // of the range; and more than rounding
  const int margin = std::max(2, static_cast<int>(noise * (largest - least)));
  const int middle = (least + largest) / 2;
  const int band = std::max(1, (largest - least) / 20);
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
    for (std::size_t next = 0; next < 3; ++next) {
      edges.crossings += (grey[beside[next]] >= middle) != (here >= middle) ? 1 : 0;
    }
    if (std::abs(here - middle) <= band) {
      ++edges.middle;
      if (darkest >= middle - band && brightest <= middle + band) ++edges.inside_middle;
    }
    const bool is_bright = here >= parted;
    GreySide& side = edges.sides[is_bright ? 1 : 0];
    if (darkest == brightest && darkest == (2 * darkest > least + largest ? largest : least)) {
      GreySide& around = edges.sides[darkest == largest ? 1 : 0];
      ++around.flat;
      if (std::abs(here - darkest) >= margin) ++around.specks;
    }
    if ((darkest >= parted) != is_bright || (brightest >= parted) != is_bright) continue;
    ++side.inner;
    if (here - brightest >= margin || darkest - here >= margin) ++side.peaks;
  }
  return edges;
}

}  // namespace

CutOffGreys cut_off_greys(const std::vector<std::uint16_t>& grey,
                          const std::vector<std::uint8_t>& outside, const VoxelCounts& sizes) {
  const std::vector<std::uint64_t> counts = counts_of_all(grey, outside);
  CutOffGreys found;
  const auto least = static_cast<std::ptrdiff_t>(quantile_of(counts, 0.0));
  const auto largest = static_cast<std::ptrdiff_t>(quantile_of(counts, 1.0));
  if (least == largest) return found;
  const auto parted = static_cast<std::ptrdiff_t>(otsu_level(counts));
  const auto sum = [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    return static_cast<double>(std::accumulate(
        counts.begin() + begin, counts.begin() + std::max(begin, end), std::uint64_t{0}));
  };
  const GreyEdges edges = edges_of(grey, outside, sizes, static_cast<int>(parted),
                                   static_cast<int>(least), static_cast<int>(largest));
  const auto middle = static_cast<double>(edges.middle);
  // Labels have voxels of middle values inside of bodies.
  constexpr double few_middle = 50.0;
  const bool has_edges =
      middle >= few_middle && static_cast<double>(edges.inside_middle) <= 0.1 * middle;
  found.has_edges = has_edges;
  // Edges of a blurred scan have 3 and more times as many values in the tenth beside a phase as in
  // the middle one, those of voxels that are partly filled as many; the latter are a voxel thick.
  const double thickness = middle / (static_cast<double>(edges.crossings) / 1.5);
  const std::ptrdiff_t tenth = (largest - least) / 10;
  constexpr std::ptrdiff_t fine = 6;  // steps
  const bool are_fine = has_edges && tenth >= fine && middle >= 200.0;
  std::array<double, 2> fractions{};
  std::array<bool, 2> ends_at_once{};
  std::array<bool, 2> has_noise{};
  for (const std::size_t k : {0U, 1U}) {
    const GreySide& side = edges.sides[k];
    const GreySide& other = edges.sides[1 - k];
    const std::ptrdiff_t end = k == 0 ? least : largest;
    const double all = k == 0 ? sum(least, parted) : sum(parted, largest + 1);
    fractions[k] = static_cast<double>(counts[static_cast<std::size_t>(end)]) / all;
    const double near = k == 0 ? sum(least + 1, least + tenth) : sum(largest - tenth + 1, largest);
    constexpr double many = 0.2;
    constexpr double most = 0.6;
    ends_at_once[k] = are_fine && fractions[k] > many && near < 2.2 * middle;
    const bool is_noise_beyond = fractions[k] > most && static_cast<double>(other.peaks) >
                                                            0.05 * static_cast<double>(other.inner);
    const bool is_noise_at_end =
        has_edges && fractions[k] > many && side.specks >= 20 &&
        static_cast<double>(side.specks) > 0.001 * static_cast<double>(side.flat);
    has_noise[k] = is_noise_beyond || is_noise_at_end;
  }
  const bool are_thick = thickness > 0.13;
  if (has_noise[0] || has_noise[1]) {
    if (has_noise[0] || (are_thick && ends_at_once[0])) found.least = fractions[0];
    if (has_noise[1] || (are_thick && ends_at_once[1])) found.largest = fractions[1];
    return found;
  }
  const double at_ends = static_cast<double>(counts[static_cast<std::size_t>(least)] +
                                             counts[static_cast<std::size_t>(largest)]) /
                         sum(least, largest + 1);
  constexpr double nearly_all = 0.9;
  const bool is_told = are_thick || at_ends > nearly_all;
  if (is_told && (ends_at_once[0] || ends_at_once[1])) found.at_ends = at_ends;
  return found;
}

}  // namespace wscvt
