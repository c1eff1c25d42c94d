// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

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

}  // namespace wscvt
