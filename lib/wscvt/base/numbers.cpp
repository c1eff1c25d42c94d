// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/numbers.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace wscvt {

double quantile(const std::vector<double>& ascending, double fraction) {
  if (ascending.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto last = static_cast<double>(ascending.size() - 1);
  const double place = std::clamp(fraction * (last + 1.0) - 0.5, 0.0, last);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  const double part = place - static_cast<double>(below);
  return ascending[below] + part * (ascending[above] - ascending[below]);
}

}  // namespace wscvt
