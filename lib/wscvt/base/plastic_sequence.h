// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

namespace wscvt {

/// Returns point `i` of a sequence in [0, 1)^2. Any run of consecutive points is spread evenly. It
/// is the additive recurrence of the plastic number p, with steps 1/p and 1/p^2 (M. Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018).
inline Eigen::Vector2d plastic_point(std::size_t i) {
  constexpr double first_step = 0.75487766624669276;
  constexpr double second_step = 0.56984029099805327;
  const auto index = static_cast<double>(i);
  const double u = 0.5 + index * first_step;
  const double v = 0.5 + index * second_step;
  return {u - std::floor(u), v - std::floor(v)};
}

}  // namespace wscvt
