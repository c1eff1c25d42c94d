// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace wscvt {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Distribution::Distribution(const Eigen::VectorXd& values)
    : Distribution(values, Eigen::VectorXd::Ones(values.size())) {}

Distribution::Distribution(const std::vector<double>& values)
    : Distribution(Eigen::Map<const Eigen::VectorXd>(values.data(), values.size()).eval()) {}

Distribution::Distribution(const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
  std::vector<std::pair<double, std::uint32_t>> sorted;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k]) && std::isfinite(weights[k]) && weights[k] > 0.0) {
      sorted.emplace_back(values[k], static_cast<std::uint32_t>(k));
    }
  }
  // Equal values keep the order of the grains, so that sums have equal bits everywhere.
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [value, grain] : sorted) grains_.push_back(grain);
  double total = 0.0;
  for (const std::uint32_t grain : grains_) {
    values_.push_back(values[grain]);
    weights_.push_back(weights[grain]);
    middles_.push_back(total + 0.5 * weights[grain]);
    total += weights[grain];
  }
  for (double& middle : middles_) middle /= total;
}

double Distribution::mean() const {
  const double total = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  return std::inner_product(values_.begin(), values_.end(), weights_.begin(), 0.0) / total;
}

double Distribution::deviation() const {
  if (size() < 2) return no_number;
  // The mean of equal values may differ from them by rounding.
  if (values_.front() == values_.back()) return 0.0;
  const double middle = mean();
  double total = 0.0;
  double squares = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < size(); ++k) {
    total += weights_[k];
    squares += weights_[k] * weights_[k];
    sum += weights_[k] * (values_[k] - middle) * (values_[k] - middle);
  }
  return std::sqrt(sum / (total - squares / total));
}

double Distribution::quantile(double fraction) const {
  if (values_.empty()) return no_number;
  const auto above = std::lower_bound(middles_.begin(), middles_.end(), fraction);
  if (above == middles_.begin()) return values_.front();
  if (above == middles_.end()) return values_.back();
  const auto k = static_cast<std::size_t>(above - middles_.begin());
  const double part = (fraction - middles_[k - 1]) / (middles_[k] - middles_[k - 1]);
  return values_[k - 1] + part * (values_[k] - values_[k - 1]);
}

}  // namespace wscvt
