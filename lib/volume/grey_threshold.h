// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace wscvt {

/// The grey value that parts a histogram of two peaks, void and material: half way between the
/// peaks. Otsu's threshold finds the two sides, and the peak of each is the fullest place of its
/// counts, smoothed. Otsu's own threshold lies nearer to the wider side, and is off by what the
/// shares of the two are. `counts` are those of the grey values 0, 1, 2, ...; at least two of them
/// are above 0.
double level_between_peaks(const std::vector<std::uint64_t>& counts);

/// Otsu's: the grey value, of those that the histogram has, that parts it into values below and
/// from it on with the largest variance between the means of the two.
double otsu_level(const std::vector<std::uint64_t>& counts);

}  // namespace wscvt
