// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace wscvt {

/// Returns the size curve of grains as a table: equivalent diameter and percentage finer by mass,
/// from 0 at the smallest grain to 100 at the largest, in steps of 2 %. read_given_sizes reads it.
/// Diameters above 0, length; throws Error(InvalidInput) if there are none.
std::string size_curve_csv(std::vector<double> diameters);

/// Returns the same curve for MercuryDPM, PSD::setPSDFromCSV with CUMULATIVE_VOLUME_DISTRIBUTION:
/// radius and fraction finer by volume, without a heading.
std::string mercury_psd_csv(std::vector<double> diameters);

}  // namespace wscvt
