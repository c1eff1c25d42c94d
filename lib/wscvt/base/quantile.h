// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace wscvt {

/// Returns the value below which a fraction, 0 to 1, of values in ascending order lies. Half of a
/// value counts as below itself (Hazen 1914), and the function is linear between neighbours. Beyond
/// the middle of the first and of the last value it is that value. All quantiles of this library
/// are Hazen's (method="hazen" of NumPy), because these exist with weights too, see Distribution.
/// NaN for no value.
double quantile(const std::vector<double>& ascending, double fraction);

}  // namespace wscvt
