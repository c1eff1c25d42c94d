// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/grey_threshold.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wscvt {

namespace {

/// Counts and their moments below a level.
struct Side {
  double count = 0.0;
  double sum = 0.0;
  double mean() const { return sum / count; }
};

Side side_of(const std::vector<std::uint64_t>& counts, std::size_t begin, std::size_t end) {
  Side side;
  for (std::size_t k = begin; k < end; ++k) {
    side.count += static_cast<double>(counts[k]);
    side.sum += static_cast<double>(counts[k]) * static_cast<double>(k);
  }
  return side;
}

/// Returns the middle of the fullest window of `width` values; of a flat peak, the peak's middle.
double peak_of(const std::vector<std::uint64_t>& counts, std::size_t begin, std::size_t end,
               std::size_t width) {
  std::uint64_t sum = 0;
  std::uint64_t most = 0;
  double first = 0.0;
  double last = 0.0;
  for (std::size_t k = begin; k < end; ++k) {
    sum += counts[k];
    if (k >= begin + width) sum -= counts[k - width];
    const double middle = static_cast<double>(k) - 0.5 * static_cast<double>(width - 1);
    if (sum > most) first = middle;
    if (sum >= most) last = middle;
    most = std::max(most, sum);
  }
  return 0.5 * (first + last);
}

}  // namespace

double otsu_level(const std::vector<std::uint64_t>& counts) {
  const Side all = side_of(counts, 0, counts.size());
  Side below;
  double best = -1.0;
  double level = 0.0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    const Side above = {all.count - below.count, all.sum - below.sum};
    if (below.count > 0.0) {
      const double apart = above.mean() - below.mean();
      const double variance = below.count * above.count * apart * apart;
      if (variance > best) {
        best = variance;
        level = static_cast<double>(k);
      }
    }
    below.count += static_cast<double>(counts[k]);
    below.sum += static_cast<double>(counts[k]) * static_cast<double>(k);
  }
  return level;
}

double level_between_peaks(const std::vector<std::uint64_t>& counts) {
  const auto parted = static_cast<std::size_t>(otsu_level(counts));
  const double contrast =
      side_of(counts, parted, counts.size()).mean() - side_of(counts, 0, parted).mean();
  // Wide against the noise of the counts, narrow against the distance of the peaks.
  const auto width = static_cast<std::size_t>(std::max(1.0, std::round(contrast / 8.0)));
  return 0.5 * (peak_of(counts, 0, parted, width) + peak_of(counts, parted, counts.size(), width));
}

}  // namespace wscvt
