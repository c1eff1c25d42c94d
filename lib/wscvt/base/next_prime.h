// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// The smallest prime above a number, which is at least 1 and below 2^31 - 1.
constexpr int next_prime(int above) {
  for (int number = above + 1;; ++number) {
    bool is_prime = true;
    for (int factor = 2; factor <= number / factor && is_prime; ++factor) {
      is_prime = number % factor != 0;
    }
    if (is_prime) return number;
  }
}

}  // namespace wscvt
