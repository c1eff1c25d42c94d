// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// Half the circumference of the unit circle. <cmath> names it only beside the standard (M_PI), and
/// <numbers> only from C++20 on.
inline constexpr double pi = 3.14159265358979323846;

}  // namespace wscvt
