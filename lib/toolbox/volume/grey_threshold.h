// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace wscvt {

/// Returns the grey value half way between the two peaks of a histogram, void and material. Otsu's
/// threshold separates the two sides; each peak is the maximum of its side's smoothed counts.
/// Otsu's threshold itself lies nearer to the wider side, and depends on the fractions of the two.
/// `counts` are for the grey values 0, 1, 2, ...; at least two are above 0.
double level_between_peaks(const std::vector<std::uint64_t>& counts);

/// A material or void in a histogram.
struct GreyPeak {
  std::size_t value = 0;     ///< of the fullest counts
  std::size_t valley = 0;    ///< the value of the fewest counts between it and the next peak
  std::uint64_t voxels = 0;  ///< from the valley before it to its own
};

/// Returns the peaks of a histogram, ascending: each stands out from the valleys beside it by four
/// tenths of its height, and has at least one voxel of a thousand.
std::vector<GreyPeak> peaks_of(const std::vector<std::uint64_t>& counts);

/// Returns the value up to which a fraction of all counts lies.
std::size_t quantile_of(const std::vector<std::uint64_t>& counts, double fraction);

/// Returns the level half way between two neighbouring peaks, the second of which is `upper`.
double level_below(const std::vector<std::uint64_t>& counts, const std::vector<GreyPeak>& peaks,
                   std::size_t upper);

/// Returns the grey value around which a histogram rises again between the two phases beside a
/// level, as of a film of water around grains: blur alone has the fewest counts in the middle.
/// Empty: it does not rise. `contrast`: between the phases.
std::optional<double> film_between(const std::vector<std::uint64_t>& counts, double level,
                                   double contrast);

/// Returns twice the distance of a level to the nearer one of the fullest values on its two sides;
/// 0 if a side is empty.
double contrast_at(const std::vector<std::uint64_t>& counts, double level);

/// Returns Otsu's threshold: the grey value in the histogram for which the values below and from it
/// on have the largest variance between their means.
double otsu_level(const std::vector<std::uint64_t>& counts);

}  // namespace wscvt
