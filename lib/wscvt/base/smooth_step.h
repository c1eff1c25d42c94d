// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace wscvt {

/// Returns 0 up to x = 0, 1 from x = 1 on, and a smooth value between.
inline double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace wscvt
