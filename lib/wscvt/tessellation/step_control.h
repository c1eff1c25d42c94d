// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

namespace wscvt {

/// Notices seeds that no longer come nearer to rest, as under steep weightings on rough scans,
/// whose flips never end: displacements of 0.05 h from the 70th iteration to the 1000th, at the
/// same spread of the cells' areas.
class StallWatch {
 public:
  /// Whether none of the last three fifties of steps had a mean displacement well below the best
  /// before. The slowest relaxations that come to rest gain a tenth in fifty steps; of a few
  /// hundred seeds some rest for a hundred steps and go on.
  bool stalled_at(double displacement) {
    sum_ += displacement;
    if (++steps_ < window) return false;
    if (sum_ < 0.95 * smallest_sum_) {
      smallest_sum_ = sum_;
      idle_ = 0;
    } else {
      ++idle_;
    }
    sum_ = 0.0;
    steps_ = 0;
    return idle_ >= 3;
  }

 private:
  static constexpr int window = 50;
  double sum_ = 0.0;
  double smallest_sum_ = std::numeric_limits<double>::infinity();
  int steps_ = 0;
  int idle_ = 0;  ///< fifties without a gain
};

/// Nesterov's momentum, dropped whenever it points uphill (O'Donoghue and Candes 2015, "Adaptive
/// restart for accelerated gradient schemes").
class Momentum {
 public:
  /// The share of the last change that the next step carries on.
  double carry(bool uphill) {
    if (uphill) weight_ = 1.0;
    const double grown = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * weight_ * weight_));
    const double share = (weight_ - 1.0) / grown;
    weight_ = grown;
    return share;
  }

 private:
  double weight_ = 1.0;
};

}  // namespace wscvt
