// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "wscvt/base/pi.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

/// Returns the radius of the sphere with this volume (length^3, 0 or more): (3 V / 4 pi)^(1/3),
/// length.
inline double equivalent_radius(double volume) { return portable::cbrt(3.0 * volume / (4.0 * pi)); }

}  // namespace wscvt
