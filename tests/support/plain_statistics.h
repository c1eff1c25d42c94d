// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace wscvt::test {

/// Statistics from their definitions, as slowly as they are written down. Values and weights that
/// are not numbers, and weights of 0, do not count.
class PlainStatistics {
 public:
  PlainStatistics(const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      if (!std::isfinite(values[k]) || !(weights[k] > 0.0)) continue;
      grains_.emplace_back(values[k], weights[k]);
      total_ += weights[k];
    }
    std::sort(grains_.begin(), grains_.end());
  }
  explicit PlainStatistics(const Eigen::VectorXd& values)
      : PlainStatistics(values, Eigen::VectorXd::Ones(values.size())) {}

  double mean() const {
    double sum = 0.0;
    for (const auto& [value, weight] : grains_) sum += weight * value;
    return sum / total_;
  }
  /// Weighted squares over W - sum w^2 / W: over n - 1 for weights of 1.
  double deviation() const {
    double squares = 0.0;
    double weights = 0.0;
    for (const auto& [value, weight] : grains_) {
      squares += weight * (value - mean()) * (value - mean());
      weights += weight * weight;
    }
    return std::sqrt(squares / (total_ - weights / total_));
  }
  /// Between the middles of the weights of neighbours.
  double quantile(double share) const {
    double below = 0.0;
    double last_middle = -1.0;
    double last = grains_.front().first;
    for (const auto& [value, weight] : grains_) {
      const double middle = (below + 0.5 * weight) / total_;
      if (middle >= share) {
        if (last_middle < 0.0) return value;
        return last + (share - last_middle) / (middle - last_middle) * (value - last);
      }
      below += weight;
      last_middle = middle;
      last = value;
    }
    return last;
  }
  double fraction_up_to(double value) const {
    double sum = 0.0;
    for (const auto& [own, weight] : grains_) sum += own <= value ? weight : 0.0;
    return sum / total_;
  }
  const std::vector<std::pair<double, double>>& grains() const { return grains_; }

 private:
  std::vector<std::pair<double, double>> grains_;
  double total_ = 0.0;
};

/// Largest difference of the fractions, and the area between them.
inline std::pair<double, double> plain_distances(const PlainStatistics& a,
                                                 const PlainStatistics& b) {
  std::vector<double> places;
  for (const PlainStatistics* one : {&a, &b}) {
    for (const auto& grain : one->grains()) places.push_back(grain.first);
  }
  std::sort(places.begin(), places.end());
  double largest = 0.0;
  double area = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double apart = std::abs(a.fraction_up_to(places[k]) - b.fraction_up_to(places[k]));
    largest = std::max(largest, apart);
    if (k + 1 < places.size()) area += apart * (places[k + 1] - places[k]);
  }
  return {largest, area};
}

/// Correlation of the ranks; equal values have their mean rank.
inline double plain_rank_correlation(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  std::vector<std::pair<double, double>> rows;
  for (Eigen::Index k = 0; k < one.size(); ++k) {
    if (std::isfinite(one[k]) && std::isfinite(other[k])) rows.emplace_back(one[k], other[k]);
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::VectorXd a = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  const auto before = [](double x, double y) { return x < y ? 1.0 : x == y ? 0.5 : 0.0; };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const auto& [x, y] : rows) {
      a[i] += before(x, rows[static_cast<std::size_t>(i)].first);
      b[i] += before(y, rows[static_cast<std::size_t>(i)].second);
    }
  }
  a.array() -= a.mean();
  b.array() -= b.mean();
  return a.dot(b) / std::sqrt(a.squaredNorm() * b.squaredNorm());
}

}  // namespace wscvt::test
