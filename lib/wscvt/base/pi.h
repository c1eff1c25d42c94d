// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// Pi. M_PI of <cmath> is not standard, and <numbers> needs C++20.
inline constexpr double pi = 3.14159265358979323846;

}  // namespace wscvt
