// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "toolbox/volume/segmentation_steps.h"

namespace wscvt {

namespace {

/// Of so many voxels, a peak has at least one.
constexpr std::uint64_t fewest_of = 1000;

/// Windows in the range of all values but a thousandth at each end.
constexpr std::size_t windows = 16;

std::uint64_t sum_of(const std::vector<std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

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

/// Returns a width of windows: wide against the noise of the counts, narrow against the distance of
/// the peaks.
std::size_t peak_width(double contrast) {
  return static_cast<std::size_t>(std::max(1.0, std::round(contrast / 8.0)));
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

/// Returns the level half way between the peaks of the values [begin, middle) and [middle, end).
double level_between(const std::vector<std::uint64_t>& counts, std::size_t begin,
                     std::size_t middle, std::size_t end) {
  const std::size_t width =
      peak_width(side_of(counts, middle, end).mean() - side_of(counts, begin, middle).mean());
  return 0.5 * (peak_of(counts, begin, middle, width) + peak_of(counts, middle, end, width));
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

/// Removes the weakest peak while there is one that does not stand out.
void drop_weak_peaks(const std::vector<double>& heights, std::uint64_t all,
                     std::vector<GreyPeak>& peaks) {
  constexpr double highest_valley = 0.6;
  while (peaks.size() > 1) {
    std::size_t weakest = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < peaks.size(); ++k) {
      double valley = 0.0;
      if (k > 0) valley = heights[peaks[k - 1].valley];
      if (k + 1 < peaks.size()) valley = std::max(valley, heights[peaks[k].valley]);
      double share = valley / heights[peaks[k].value];
      if (peaks[k].voxels * fewest_of < all) share += 1.0;
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

/// Returns the distance of the values that bound all counts in [begin, end) but a thousandth at
/// each end.
std::size_t usual_range(const std::vector<std::uint64_t>& counts, std::size_t begin,
                        std::size_t end) {
  constexpr double rare = 0.001;
  const std::vector<std::uint64_t> some(counts.begin() + static_cast<std::ptrdiff_t>(begin),
                                        counts.begin() + static_cast<std::ptrdiff_t>(end));
  return quantile_of(some, 1.0 - rare) - quantile_of(some, rare);
}

/// Returns the peaks among the values [begin, end) that stand out.
std::vector<GreyPeak> peaks_between(const std::vector<std::uint64_t>& counts, std::uint64_t all,
                                    std::size_t begin, std::size_t end) {
  const std::size_t width = std::max<std::size_t>(1, usual_range(counts, begin, end) / windows);
  std::vector<double> heights(counts.begin() + static_cast<std::ptrdiff_t>(begin),
                              counts.begin() + static_cast<std::ptrdiff_t>(end));
  for (int pass = 0; pass < 2; ++pass) heights = window_sums(heights, width);
  std::vector<GreyPeak> peaks;
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
  if (!peaks.empty()) peaks.back().valley = heights.size() - 1;
  std::size_t next = 0;
  for (GreyPeak& peak : peaks) {
    for (; next <= peak.valley; ++next) peak.voxels += counts[begin + next];
  }
  drop_weak_peaks(heights, all, peaks);
  for (GreyPeak& peak : peaks) {
    peak.value += begin;
    peak.valley += begin;
  }
  return peaks;
}

/// Appends the peaks among the values [begin, end). A peak that is narrow against their range is
/// looked at again, in narrower windows: beside a very bright phase, void and grains share one.
void append_peaks(const std::vector<std::uint64_t>& counts, std::uint64_t all, std::size_t begin,
                  std::size_t end, std::vector<GreyPeak>& found) {
  const std::size_t range = usual_range(counts, begin, end);
  for (const GreyPeak& peak : peaks_between(counts, all, begin, end)) {
    constexpr std::size_t narrow = 6;
    // Void and grains together; a phase of its own has less, or keeps its shape.
    constexpr double nearly_all = 0.9;
    const std::size_t own = usual_range(counts, begin, peak.valley + 1);
    if (own >= windows && own * narrow < range &&
        static_cast<double>(peak.voxels) >= nearly_all * static_cast<double>(all)) {
      append_peaks(counts, all, begin, peak.valley + 1, found);
    } else {
      found.push_back(peak);
    }
    begin = peak.valley + 1;
  }
}

}  // namespace

std::size_t quantile_of(const std::vector<std::uint64_t>& counts, double fraction) {
  const std::uint64_t all = sum_of(counts);
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    sum += counts[k];
    if (static_cast<double>(sum) >= fraction * static_cast<double>(all) && sum > 0) return k;
  }
  return counts.size() - 1;
}

std::ptrdiff_t values_in(const std::vector<std::uint64_t>& counts) {
  return std::count_if(counts.begin(), counts.end(), [](std::uint64_t count) { return count > 0; });
}

std::vector<GreyPeak> peaks_of(const std::vector<std::uint64_t>& counts, bool has_noise) {
  constexpr std::ptrdiff_t few = 8;
  const std::uint64_t all = sum_of(counts);
  const bool are_beside =
      std::adjacent_find(counts.begin(), counts.end(), [](std::uint64_t a, std::uint64_t b) {
        return a > 0 && b > 0;
      }) != counts.end();
  std::vector<GreyPeak> peaks;
  if (values_in(counts) > few || (has_noise && are_beside)) {
    append_peaks(counts, all, 0, counts.size(), peaks);
    return peaks;
  }
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] > 0 && counts[k] * fewest_of >= all) peaks.push_back({k, k, counts[k]});
  }
  return peaks;
}

double level_below(const std::vector<std::uint64_t>& counts, const std::vector<GreyPeak>& peaks,
                   std::size_t upper) {
  const std::size_t begin = upper > 1 ? peaks[upper - 2].valley + 1 : 0;
  const std::size_t middle = peaks[upper - 1].valley + 1;
  const std::size_t end = upper + 1 == peaks.size() ? counts.size() : peaks[upper].valley + 1;
  return level_between(counts, begin, middle, end);
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

std::optional<double> film_between(const std::vector<std::uint64_t>& counts, double level,
                                   double contrast) {
  // Without the phases themselves.
  constexpr double reach = 0.35;
  const double begin = std::ceil(level - reach * contrast);
  const auto width = static_cast<std::size_t>(std::max(1.0, std::round(0.05 * contrast)));
  const auto bins = static_cast<std::size_t>(2.0 * reach * contrast / static_cast<double>(width));
  const double end = begin + static_cast<double>(bins * width);
  if (bins < 5 || begin < 0.0 || end > static_cast<double>(counts.size())) return std::nullopt;
  const auto first = static_cast<std::size_t>(begin);
  std::vector<double> sums(bins, 0.0);
  for (std::size_t k = 0; k < bins * width; ++k) {
    sums[k / width] += static_cast<double>(counts[first + k]);
  }
  std::vector<double> smooth = sums;
  for (std::size_t k = 1; k + 1 < bins; ++k) {
    smooth[k] = 0.25 * sums[k - 1] + 0.5 * sums[k] + 0.25 * sums[k + 1];
  }
  // Blur and noise alone gave up to 1.06 in studies of balls, films of 1.6 to 3.5 voxels 1.5 and
  // more. Few voxels rise by chance.
  constexpr double least_rise = 1.4;
  constexpr double fewest = 400.0;
  double most = least_rise;
  std::optional<double> found;
  for (std::size_t k = 1; k + 1 < bins; ++k) {
    const auto here = smooth.begin() + static_cast<std::ptrdiff_t>(k);
    const double valley = std::max(
        {*std::min_element(smooth.begin(), here), *std::min_element(here + 1, smooth.end()), 1.0});
    if (*here < fewest || *here < most * valley) continue;
    most = *here / valley;
    found = begin + (static_cast<double>(k) + 0.5) * static_cast<double>(width);
  }
  return found;
}

double contrast_at(const std::vector<std::uint64_t>& counts, double level) {
  const auto size = static_cast<double>(counts.size());
  const auto parted = static_cast<std::size_t>(std::clamp(std::ceil(level), 0.0, size));
  const Side below = side_of(counts, 0, parted);
  const Side above = side_of(counts, parted, counts.size());
  if (!(below.count > 0.0 && above.count > 0.0)) return 0.0;
  const std::size_t width = peak_width(above.mean() - below.mean());
  return 2.0 * std::min(level - peak_of(counts, 0, parted, width),
                        peak_of(counts, parted, counts.size(), width) - level);
}

double level_between_peaks(const std::vector<std::uint64_t>& counts) {
  return level_between(counts, 0, static_cast<std::size_t>(otsu_level(counts)), counts.size());
}

}  // namespace wscvt
