// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/numbers.h"

namespace wscvt {

/// One number of each grain of a sample, in ascending order, with the grains' weights: equal
/// weights for statistics by number, masses for statistics by mass. Grains without the number or
/// without a positive weight are left out.
class Distribution {
 public:
  Distribution() = default;
  /// `values` and `weights` have a row per grain; NaN: missing. Without `weights` all weights are
  /// 1.
  explicit Distribution(const Eigen::VectorXd& values);
  explicit Distribution(const std::vector<double>& values);
  Distribution(const Eigen::VectorXd& values, const Eigen::VectorXd& weights);

  std::size_t size() const { return values_.size(); }
  const std::vector<double>& values() const { return values_; }
  const std::vector<double>& weights() const { return weights_; }
  /// Returns the grain of each value: a row of the constructor's vectors.
  const std::vector<std::uint32_t>& grains() const { return grains_; }

  /// sum w x / sum w; NaN for no value.
  double mean() const;

  /// Returns the standard deviation of the population from which the values are drawn, with an
  /// unbiased variance: the square root of sum w (x - mean)^2 / (W - sum w^2 / W), W = sum w. With
  /// equal weights it divides by n - 1. NaN for fewer than two values.
  double deviation() const;

  /// Returns the value below which a fraction of the weight lies, 0 to 1. Half of a grain's weight
  /// counts as below its own value (Hazen 1914), and the function is linear between neighbours.
  /// Beyond the middle of the first and of the last grain it is their value. NaN for no value.
  double quantile(double fraction) const;

 private:
  std::vector<double> values_;
  std::vector<double> weights_;
  std::vector<std::uint32_t> grains_;
  std::vector<double> middles_;  ///< weight below the middle of each grain / all
};

}  // namespace wscvt
