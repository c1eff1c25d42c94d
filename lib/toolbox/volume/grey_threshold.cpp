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

/// Returns the sums over windows of `width` values about each value.
std::vector<double> window_sums(const std::vector<double>& counts, std::size_t width) {
  std::vector<double> before(counts.size() + 1, 0.0);
  for (std::size_t k = 0; k < counts.size(); ++k) before[k + 1] = before[k] + counts[k];
  std::vector<double> sums(counts.size());
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const std::size_t begin = k - std::min(k, width / 2);
    sums[k] = before[std::min(counts.size(), k + width - width / 2)] - before[begin];
  }
  return sums;
}

/// Returns the peaks of few values: each value is one.
std::vector<GreyPeak> peaks_of_few(const std::vector<std::uint64_t>& counts) {
  std::vector<GreyPeak> peaks;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] > 0) peaks.push_back({k, k, counts[k]});
  }
  return peaks;
}

/// Removes the weakest peak while there is one that does not stand out.
void drop_weak_peaks(const std::vector<double>& heights, std::uint64_t all,
                     std::vector<GreyPeak>& peaks) {
  constexpr double highest_valley = 0.6;
  constexpr std::uint64_t fewest = 1000;  // of so many voxels one
  while (peaks.size() > 1) {
    std::size_t weakest = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < peaks.size(); ++k) {
      double valley = 0.0;
      if (k > 0) valley = heights[peaks[k - 1].valley];
      if (k + 1 < peaks.size()) valley = std::max(valley, heights[peaks[k].valley]);
      double share = valley / heights[peaks[k].value];
      if (peaks[k].voxels * fewest < all) share += 1.0;
      if (share > most) {
        most = share;
        weakest = k;
      }
    }
    if (most <= highest_valley) return;
    // It joins the neighbour across its higher valley.
    const bool is_joined_below =
        weakest + 1 == peaks.size() ||
        (weakest > 0 && heights[peaks[weakest - 1].valley] > heights[peaks[weakest].valley]);
    GreyPeak& heir = peaks[is_joined_below ? weakest - 1 : weakest + 1];
    heir.voxels += peaks[weakest].voxels;
    if (is_joined_below) heir.valley = peaks[weakest].valley;
    peaks.erase(peaks.begin() + static_cast<std::ptrdiff_t>(weakest));
  }
}

}  // namespace

std::size_t quantile_of(const std::vector<std::uint64_t>& counts, double fraction) {
  std::uint64_t all = 0;
  for (const std::uint64_t count : counts) all += count;
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    sum += counts[k];
    if (static_cast<double>(sum) >= fraction * static_cast<double>(all) && sum > 0) return k;
  }
  return counts.size() - 1;
}

std::vector<GreyPeak> peaks_of(const std::vector<std::uint64_t>& counts) {
  constexpr std::ptrdiff_t few = 8;
  const auto is_some = [](std::uint64_t count) { return count > 0; };
  const bool are_few = std::count_if(counts.begin(), counts.end(), is_some) <= few;
  // Windows of a sixteenth of the range of all values but a thousandth at each end.
  constexpr double rare = 0.001;
  const std::size_t range = quantile_of(counts, 1.0 - rare) - quantile_of(counts, rare);
  const std::size_t width = std::max<std::size_t>(1, range / 16);
  std::vector<double> heights(counts.begin(), counts.end());
  std::vector<GreyPeak> peaks;
  if (are_few) {
    peaks = peaks_of_few(counts);
  } else {
    for (int pass = 0; pass < 2; ++pass) heights = window_sums(heights, width);
    bool is_rising = true;
    for (std::size_t k = 0; k < heights.size(); ++k) {
      const double next = k + 1 < heights.size() ? heights[k + 1] : -1.0;
      if (is_rising && next < heights[k]) {
        peaks.push_back({k, k, 0});
        is_rising = false;
      } else if (!is_rising && next > heights[k]) {
        peaks.back().valley = k;
        is_rising = true;
      }
    }
    if (!peaks.empty()) peaks.back().valley = counts.size() - 1;
    std::size_t begin = 0;
    for (GreyPeak& peak : peaks) {
      for (; begin <= peak.valley; ++begin) peak.voxels += counts[begin];
    }
  }
  std::uint64_t all = 0;
  for (const std::uint64_t count : counts) all += count;
  if (are_few) {
    constexpr std::uint64_t fewest = 1000;
    peaks.erase(std::remove_if(peaks.begin(), peaks.end(),
                               [&](const GreyPeak& peak) { return peak.voxels * fewest < all; }),
                peaks.end());
  } else {
    drop_weak_peaks(heights, all, peaks);
  }
  return peaks;
}

double level_below(const std::vector<std::uint64_t>& counts, const std::vector<GreyPeak>& peaks,
                   std::size_t upper) {
  const std::size_t begin = upper > 1 ? peaks[upper - 2].valley + 1 : 0;
  const std::size_t middle = peaks[upper - 1].valley + 1;
  const std::size_t end = upper + 1 == peaks.size() ? counts.size() : peaks[upper].valley + 1;
  const double contrast =
      side_of(counts, middle, end).mean() - side_of(counts, begin, middle).mean();
  // Wide against the noise of the counts, narrow against the distance of the peaks.
  const auto width = static_cast<std::size_t>(std::max(1.0, std::round(contrast / 8.0)));
  return 0.5 * (peak_of(counts, begin, middle, width) + peak_of(counts, middle, end, width));
}

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
