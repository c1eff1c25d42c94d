// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace wscvt {

/// Returns the grey value half way between the two peaks of a histogram, void and material. Otsu's
/// threshold separates the two sides; each peak is the maximum of its side's smoothed counts.
/// Otsu's threshold itself lies nearer to the wider side, and depends on the fractions of the two.
/// `counts` are for the grey values 0, 1, 2, ...; at least two are above 0.
double level_between_peaks(const std::vector<std::uint64_t>& counts);

/// Returns Otsu's threshold: the grey value in the histogram for which the values below and from it
/// on have the largest variance between their means.
double otsu_level(const std::vector<std::uint64_t>& counts);

}  // namespace wscvt
