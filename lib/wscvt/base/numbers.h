// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "wscvt/base/portable_math.h"

namespace wscvt {

/// Pi. M_PI of `<cmath>` is not standard, and `<numbers>` needs C++20.
inline constexpr double pi = 3.14159265358979323846;

/// Returns the radius of the sphere with this volume (length^3, 0 or more): (3 V / 4 pi)^(1/3),
/// length.
inline double equivalent_radius(double volume) { return portable::cbrt(3.0 * volume / (4.0 * pi)); }

/// Returns the value below which a fraction, 0 to 1, of values in ascending order lies. Half of a
/// value counts as below itself (Hazen 1914), and the function is linear between neighbours. Beyond
/// the middle of the first and of the last value it is that value. All quantiles of this library
/// are Hazen's (method="hazen" of NumPy), because these exist with weights too, see Distribution.
/// NaN for no value.
inline double quantile(const std::vector<double>& ascending, double fraction) {
  if (ascending.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto last = static_cast<double>(ascending.size() - 1);
  const double place = std::clamp(fraction * (last + 1.0) - 0.5, 0.0, last);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  const double part = place - static_cast<double>(below);
  return ascending[below] + part * (ascending[above] - ascending[below]);
}

/// Returns the value, or 0 if it is below 1e-9 of a scale. Sums over a million triangles have
/// errors of some 1e-12 of their scale, so that such a value is rounding.
inline double without_rounding(double value, double scale) {
  return std::abs(value) < 1e-9 * std::abs(scale) ? 0.0 : value;
}

/// Returns 0 up to x = 0, 1 from x = 1 on, and a smooth value between.
inline double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Returns the smallest prime above a number from 1 to 2^31 - 2.
constexpr int next_prime(int above) {
  for (int number = above + 1;; ++number) {
    bool is_prime = true;
    for (int factor = 2; factor <= number / factor && is_prime; ++factor) {
      is_prime = number % factor != 0;
    }
    if (is_prime) return number;
  }
}

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
