// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sample/sample_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "wscvt/sample/distribution.h"
#include "wscvt/sample/random_stream.h"

namespace wscvt {

namespace {

constexpr double no_statistic = std::numeric_limits<double>::quiet_NaN();

/// Two-sided 95 % of the normal distribution.
constexpr double normal_95 = 1.959963984540054;

/// Draws and sorted sums cost n a repetition: above this many grains fewer are made.
constexpr std::size_t most_grains_at_full = 20000;
constexpr int least_repetitions = 200;

/// Mean, deviation, 10, 50 and 90 %: what is repeated of a column.
constexpr std::size_t column_numbers = 5;
const std::vector<double> column_shares = {0.1, 0.5, 0.9};
/// D10 to D90, Cu, Cc: what is repeated of the size.
constexpr std::size_t size_numbers = 7;
const std::vector<double> size_shares = {0.1, 0.3, 0.5, 0.6, 0.9};

/// A distribution whose grains are drawn again and again.
class Repeated {
 public:
  Repeated(const Eigen::VectorXd& values, const Eigen::VectorXd& weights, bool is_size)
      : distribution_(values, weights), middle_(distribution_.mean()), is_size_(is_size) {}

  std::size_t numbers() const { return is_size_ ? size_numbers : column_numbers; }

  /// The statistics of a draw in which the grains come `times`. `weights` is room to work in.
  void measure(const std::vector<std::uint16_t>& times, std::vector<double>& weights,
               double* result) const {
    const std::vector<double>& values = distribution_.values();
    const std::vector<double>& own = distribution_.weights();
    const std::vector<std::uint32_t>& grains = distribution_.grains();
    weights.resize(values.size());
    // In one pass, about the mean of the sample, where no digits are lost. A grain that was drawn
    // twice is two grains.
    double total = 0.0;
    double squares = 0.0;
    double first = 0.0;
    double second = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double weight = times[grains[k]] * own[k];
      const double difference = values[k] - middle_;
      weights[k] = weight;
      total += weight;
      squares += weight * own[k];
      first += weight * difference;
      second += weight * difference * difference;
    }
    if (!(total > 0.0)) {
      // No grain of the draw has a value.
      std::fill(result, result + numbers(), no_statistic);
    } else if (is_size_) {
      weighted_quantiles(values, weights, total, size_shares, result);
      result[5] = result[3] / result[0];
      result[6] = result[1] * result[1] / (result[0] * result[3]);
    } else {
      result[0] = middle_ + first / total;
      const double spread = std::max(0.0, second - first * first / total);
      result[1] = std::sqrt(spread / (total - squares / total));
      weighted_quantiles(values, weights, total, column_shares, result + 2);
    }
  }

 private:
  Distribution distribution_;
  double middle_;
  bool is_size_;
};

/// The middle 95 % of what repetitions gave, about the value of the sample itself.
Estimate estimate_of(double value, std::vector<double>& repeated) {
  repeated.erase(std::remove_if(repeated.begin(), repeated.end(),
                                [](double one) { return !std::isfinite(one); }),
                 repeated.end());
  if (repeated.empty() || !std::isfinite(value)) return {value, no_statistic, no_statistic};
  const Distribution all(Eigen::Map<const Eigen::VectorXd>(
      repeated.data(), static_cast<Eigen::Index>(repeated.size())));
  return {value, all.quantile(0.025), all.quantile(0.975)};
}

int repetitions_for(std::size_t grains, int asked) {
  if (grains <= most_grains_at_full || asked <= least_repetitions) return asked;
  const double share = static_cast<double>(most_grains_at_full) / static_cast<double>(grains);
  return std::max(least_repetitions, static_cast<int>(asked * share));
}

/// Estimates of all distributions' numbers, one after the other.
std::vector<Estimate> bootstrap(const std::vector<Repeated>& all, std::size_t grains,
                                int repetitions, std::uint64_t seed, const Execution& execution) {
  std::size_t width = 0;
  for (const Repeated& one : all) width += one.numbers();
  std::vector<double> drawn(width * static_cast<std::size_t>(repetitions));
  execution.parallel_for(static_cast<std::size_t>(repetitions), 4,
                         [&](std::size_t begin, std::size_t end) {
                           std::vector<std::uint16_t> times;
                           std::vector<double> weights;
                           for (std::size_t k = begin; k < end; ++k) {
                             RandomStream random(seed, k);
                             times.assign(grains, 0);
                             for (std::size_t draw = 0; draw < grains; ++draw)
                               ++times[random.below(grains)];
                             double* result = &drawn[k * width];
                             for (const Repeated& one : all) {
                               one.measure(times, weights, result);
                               result += one.numbers();
                             }
                           }
                         });
  std::vector<Estimate> estimates;
  std::vector<double> repeated;
  const std::vector<std::uint16_t> once(grains, 1);
  std::vector<double> weights;
  for (const Repeated& one : all) {
    std::vector<double> own(one.numbers());
    one.measure(once, weights, own.data());
    for (const double value : own) {
      repeated.clear();
      for (std::size_t k = estimates.size(); k < drawn.size(); k += width) {
        repeated.push_back(drawn[k]);
      }
      estimates.push_back(estimate_of(value, repeated));
    }
  }
  return estimates;
}

SizeEstimates size_estimates(const Estimate* at) {
  return {at[0], at[1], at[2], at[3], at[4], at[5], at[6]};
}

ColumnEstimates column_estimates(const Estimate* at) { return {at[0], at[1], at[2], at[3], at[4]}; }

/// Ranks from 1, those of equal values their mean.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    for (std::size_t k = begin; k < end; ++k) ranks[order[k]] = rank;
    begin = end;
  }
  return ranks;
}

}  // namespace

Estimate rank_correlation(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  std::vector<double> a;
  std::vector<double> b;
  for (Eigen::Index k = 0; k < one.size(); ++k) {
    if (!std::isfinite(one[k]) || !std::isfinite(other[k])) continue;
    a.push_back(one[k]);
    b.push_back(other[k]);
  }
  const auto n = static_cast<double>(a.size());
  if (a.size() < 4) return {no_statistic, no_statistic, no_statistic};
  a = ranks_of(a);
  b = ranks_of(b);
  const double middle = 0.5 * (n + 1.0);
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ab += (a[k] - middle) * (b[k] - middle);
    aa += (a[k] - middle) * (a[k] - middle);
    bb += (b[k] - middle) * (b[k] - middle);
  }
  const double r = ab / std::sqrt(aa * bb);
  if (!std::isfinite(r)) return {no_statistic, no_statistic, no_statistic};
  const double z = std::atanh(std::clamp(r, -1.0, 1.0));
  const double reach = normal_95 * std::sqrt((1.0 + 0.5 * r * r) / (n - 3.0));
  return {r, std::tanh(z - reach), std::tanh(z + reach)};
}

SampleStatistics measure_sample(const GrainSample& sample, const SampleOptions& options,
                                const Execution& execution) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(sample.sizes.size());
  std::vector<Repeated> all;
  for (const Eigen::VectorXd* weights : {&ones, &sample.masses}) {
    all.emplace_back(sample.sizes, *weights, true);
    for (Eigen::Index k = 0; k < sample.values.cols(); ++k) {
      all.emplace_back(sample.values.col(k), *weights, false);
    }
  }
  SampleStatistics statistics;
  statistics.repetitions = repetitions_for(sample.grains.size(), options.repetitions);
  execution.report(0.0, "Measuring the sample");
  const std::vector<Estimate> estimates =
      bootstrap(all, sample.grains.size(), statistics.repetitions, options.seed, execution);
  const Estimate* by_number = estimates.data();
  const Estimate* by_mass = by_number + estimates.size() / 2;
  statistics.size_by_number = size_estimates(by_number);
  statistics.size_by_mass = size_estimates(by_mass);
  for (std::size_t k = 0; k < sample.columns.size(); ++k) {
    const Eigen::VectorXd values = sample.values.col(static_cast<Eigen::Index>(k));
    const Distribution distribution(values);
    ColumnStatistics column;
    column.column = sample.columns[k];
    column.count = distribution.size();
    column.smallest = distribution.quantile(0.0);
    column.largest = distribution.quantile(1.0);
    const std::size_t place = size_numbers + k * column_numbers;
    column.by_number = column_estimates(by_number + place);
    column.by_mass = column_estimates(by_mass + place);
    column.size_correlation = rank_correlation(sample.sizes, values);
    statistics.columns.push_back(column);
  }
  for (const double mass : sample.masses) {
    if (std::isfinite(mass)) statistics.mass += mass;
  }
  return statistics;
}

double grains_needed(const Estimate& estimate, std::size_t grains, double percent) {
  const double reach = 0.5 * (estimate.upper - estimate.lower);
  const double wanted = 0.01 * percent * std::abs(estimate.value);
  if (!std::isfinite(reach) || !(wanted > 0.0)) return no_statistic;
  return std::ceil(static_cast<double>(grains) * reach * reach / (wanted * wanted));
}

}  // namespace wscvt
