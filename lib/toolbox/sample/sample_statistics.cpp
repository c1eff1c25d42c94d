// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/sample_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "toolbox/sample/distribution.h"
#include "toolbox/sample/random_stream.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/measures/voxel_resolution.h"

namespace wscvt {

namespace {

constexpr double no_statistic = std::numeric_limits<double>::quiet_NaN();

/// Two-sided 95 % of the normal distribution.
constexpr double normal_95 = 1.959963984540054;

/// The cost of a repetition grows with n: above this many grains fewer are made.
constexpr std::size_t most_grains_at_full = 20000;

/// Repeated statistics of a column: mean, deviation, 10, 50 and 90 %.
constexpr std::size_t column_numbers = 5;
constexpr std::array<double, 3> column_shares = {0.1, 0.5, 0.9};
/// Repeated statistics of the size: D10 to D90, Cu, Cc.
constexpr std::size_t size_numbers = 7;
constexpr std::array<double, 5> size_shares = {0.1, 0.3, 0.5, 0.6, 0.9};

/// Draws that are summed at once: their numbers fill the registers of a processor.
constexpr std::size_t draws_at_once = 4;
using DrawNumbers = std::array<double, draws_at_once>;
/// Number of times each grain is in each draw.
using Draws = std::vector<std::array<std::uint16_t, draws_at_once>>;

/// One number of each grain, whose grains are drawn repeatedly.
class Repeated {
 public:
  Repeated() = default;
  Repeated(const Eigen::VectorXd& values, const Eigen::VectorXd& masses, bool is_size)
      : is_size_(is_size) {
    const Distribution distribution(values);
    values_ = distribution.values();
    grains_ = distribution.grains();
    middle_ = distribution.mean();
    for (const std::uint32_t grain : grains_) masses_.push_back(masses[grain]);
  }

  const std::vector<double>& values() const { return values_; }
  const std::vector<std::uint32_t>& grains() const { return grains_; }
  /// Returns the number of statistics by number, which equals the number by mass.
  std::size_t numbers() const { return is_size_ ? size_numbers : column_numbers; }

  /// Computes the statistics of the first draws, one draw per result. Each result has room for
  /// numbers() by number, then numbers() by mass.
  void measure(const Draws& draws, const std::vector<double*>& results) const;

 private:
  /// Weights of all grains below the first grain of each block.
  struct Below {
    DrawNumbers by_number{};
    DrawNumbers by_mass{};
  };
  static constexpr std::size_t block = 256;

  template <bool by_mass>
  double weight(const Draws& draws, std::size_t k, std::size_t lane) const {
    const double times = draws[grains_[k]][lane];
    return by_mass ? times * masses_[k] : times;
  }
  /// Returns Distribution::quantile of a draw whose weights sum to `total` > 0.
  template <bool by_mass>
  double quantile(const Draws& draws, const std::vector<Below>& blocks, std::size_t lane,
                  double total, double fraction) const;
  template <bool by_mass>
  void append_quantiles(const Draws& draws, const std::vector<Below>& blocks, std::size_t lane,
                        double total, double* result) const;

  std::vector<double> values_;  ///< ascending
  std::vector<double> masses_;
  std::vector<std::uint32_t> grains_;
  double middle_ = 0.0;
  bool is_size_ = false;
};

template <bool by_mass>
double Repeated::quantile(const Draws& draws, const std::vector<Below>& blocks, std::size_t lane,
                          double total, double fraction) const {
  const auto below_of = [&](const Below& one) {
    return by_mass ? one.by_mass[lane] : one.by_number[lane];
  };
  const double target = fraction * total;
  // Grains before the last block that begins below the target have their middles below it.
  const auto later = std::partition_point(blocks.begin() + 1, blocks.end(),
                                          [&](const Below& one) { return below_of(one) < target; });
  const auto first = static_cast<std::size_t>(later - blocks.begin()) - 1;
  double below = below_of(blocks[first]);
  std::size_t k = first * block;
  // A grain drawn twice is two grains, and between their middles the quantile is their value.
  const auto half = [&](std::size_t grain) { return by_mass ? 0.5 * masses_[grain] : 0.5; };
  for (; k < values_.size(); ++k) {
    const double own = weight<by_mass>(draws, k, lane);
    if (own > 0.0 && below + own - half(k) >= target) break;
    below += own;
  }
  // The previous grain among the drawn ones.
  std::size_t last = k;
  while (last > 0 && draws[grains_[last - 1]][lane] == 0) --last;
  if (last == 0) return values_[k];
  --last;
  if (k == values_.size()) return values_[last];
  const double last_middle = below - half(last);
  const double part = std::min(1.0, (target - last_middle) / (below + half(k) - last_middle));
  return values_[last] + part * (values_[k] - values_[last]);
}

template <bool by_mass>
void Repeated::append_quantiles(const Draws& draws, const std::vector<Below>& blocks,
                                std::size_t lane, double total, double* result) const {
  if (is_size_) {
    for (const double share : size_shares) {
      *result++ = quantile<by_mass>(draws, blocks, lane, total, share);
    }
    const double* const d = result - size_shares.size();
    result[0] = d[3] / d[0];
    result[1] = d[1] * d[1] / (d[0] * d[3]);
    return;
  }
  for (const double share : column_shares) {
    *result++ = quantile<by_mass>(draws, blocks, lane, total, share);
  }
}

void Repeated::measure(const Draws& draws, const std::vector<double*>& results) const {
  // One pass, about the mean of the sample, so that no digits are lost. A grain drawn twice is two
  // grains, also in the sum of the squared masses.
  DrawNumbers count{};
  DrawNumbers first{};
  DrawNumbers second{};
  DrawNumbers mass{};
  DrawNumbers squares{};
  DrawNumbers mass_first{};
  DrawNumbers mass_second{};
  std::vector<Below> blocks(values_.size() / block + 1);
  for (std::size_t k = 0; k < values_.size(); ++k) {
    if (k % block == 0) blocks[k / block] = {count, mass};
    const double difference = values_[k] - middle_;
    const double own = masses_[k];
    const std::array<std::uint16_t, draws_at_once>& times = draws[grains_[k]];
    for (std::size_t lane = 0; lane < draws_at_once; ++lane) {
      const double drawn = times[lane];
      const double drawn_mass = drawn * own;
      count[lane] += drawn;
      first[lane] += drawn * difference;
      second[lane] += drawn * difference * difference;
      mass[lane] += drawn_mass;
      squares[lane] += drawn_mass * own;
      mass_first[lane] += drawn_mass * difference;
      mass_second[lane] += drawn_mass * difference * difference;
    }
  }
  if (values_.size() % block == 0) blocks.back() = {count, mass};
  const auto moments = [&](double total, double sum, double square, double weights,
                           double* result) {
    result[0] = middle_ + sum / total;
    result[1] = std::sqrt(std::max(0.0, square - sum * sum / total) / (total - weights / total));
  };
  const std::size_t own_numbers = is_size_ ? 0 : 2;
  for (std::size_t lane = 0; lane < results.size(); ++lane) {
    double* const by_number = results[lane];
    double* const by_mass = by_number + numbers();
    // A draw may have no grain with a value, or none with a mass.
    std::fill(by_number, by_mass + numbers(), no_statistic);
    if (count[lane] > 0.0) {
      if (!is_size_) moments(count[lane], first[lane], second[lane], count[lane], by_number);
      append_quantiles<false>(draws, blocks, lane, count[lane], by_number + own_numbers);
    }
    if (mass[lane] > 0.0) {
      if (!is_size_)
        moments(mass[lane], mass_first[lane], mass_second[lane], squares[lane], by_mass);
      append_quantiles<true>(draws, blocks, lane, mass[lane], by_mass + own_numbers);
    }
  }
}

/// Returns the sample's own value with the middle 95 % of the repetitions.
Estimate estimate_of(double value, std::vector<double>& repeated) {
  repeated.erase(std::remove_if(repeated.begin(), repeated.end(),
                                [](double one) { return !std::isfinite(one); }),
                 repeated.end());
  if (repeated.empty() || !std::isfinite(value)) return {value, no_statistic, no_statistic};
  const Distribution all(repeated);
  return {value, all.quantile(0.025), all.quantile(0.975)};
}

/// Draws as many grains as there are, with replacement, in each lane from its own stream.
void draw(std::uint64_t seed, std::size_t first_stream, std::size_t grains, Draws& draws) {
  draws.assign(grains, {});
  for (std::size_t lane = 0; lane < draws_at_once; ++lane) {
    RandomStream random(seed, first_stream + lane);
    for (std::size_t k = 0; k < grains; ++k) ++draws[random.below(grains)][lane];
  }
}

/// Estimates all columns' numbers, one after the other, by number and then by mass.
std::vector<Estimate> bootstrap(const std::vector<Repeated>& all, std::size_t grains,
                                std::size_t repetitions, std::uint64_t seed,
                                const Execution& execution) {
  std::size_t width = 0;
  for (const Repeated& one : all) width += 2 * one.numbers();
  std::vector<double> drawn(width * repetitions);
  const auto measure = [&](const Draws& draws, std::size_t begin, std::size_t end, double* rows) {
    std::vector<double*> results;
    for (std::size_t k = begin; k < end; ++k) results.push_back(rows + k * width);
    for (const Repeated& one : all) {
      one.measure(draws, results);
      for (double*& result : results) result += 2 * one.numbers();
    }
  };
  execution.parallel_for((repetitions + draws_at_once - 1) / draws_at_once, 1,
                         [&](std::size_t begin, std::size_t end) {
                           Draws draws;
                           for (std::size_t k = begin; k < end; ++k) {
                             draw(seed, k * draws_at_once, grains, draws);
                             measure(draws, k * draws_at_once,
                                     std::min(repetitions, (k + 1) * draws_at_once), drawn.data());
                           }
                         });
  std::vector<double> own(width);
  measure(Draws(grains, {1, 1, 1, 1}), 0, 1, own.data());
  std::vector<Estimate> estimates;
  std::vector<double> repeated;
  for (std::size_t k = 0; k < width; ++k) {
    repeated.clear();
    for (std::size_t row = 0; row < repetitions; ++row) repeated.push_back(drawn[row * width + k]);
    estimates.push_back(estimate_of(own[k], repeated));
  }
  return estimates;
}

SizeEstimates size_estimates(const Estimate* at) {
  return {at[0], at[1], at[2], at[3], at[4], at[5], at[6]};
}

ColumnEstimates column_estimates(const Estimate* at) { return {at[0], at[1], at[2], at[3], at[4]}; }

/// Returns the ranks, from 1, of the rows in the distribution; equal values get their mean rank.
std::vector<double> ranks_of(const std::vector<double>& values,
                             const std::vector<std::uint32_t>& rows, std::size_t count) {
  std::vector<double> ranks(count, no_statistic);
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin;
    while (end < values.size() && values[end] == values[begin]) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    for (std::size_t k = begin; k < end; ++k) ranks[rows[k]] = rank;
    begin = end;
  }
  return ranks;
}

/// Correlates ranks of the same rows; rows without a rank have none in both.
Estimate correlation_of(const std::vector<double>& one, const std::vector<double>& other,
                        std::size_t count) {
  const auto n = static_cast<double>(count);
  if (count < 4) return {no_statistic, no_statistic, no_statistic};
  const double middle = 0.5 * (n + 1.0);
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    if (std::isnan(one[k])) continue;
    ab += (one[k] - middle) * (other[k] - middle);
    aa += (one[k] - middle) * (one[k] - middle);
    bb += (other[k] - middle) * (other[k] - middle);
  }
  const double r = ab / std::sqrt(aa * bb);
  if (!std::isfinite(r)) return {no_statistic, no_statistic, no_statistic};
  const double z = portable::atanh(std::clamp(r, -1.0, 1.0));
  const double reach = normal_95 * std::sqrt((1.0 + 0.5 * r * r) / (n - 3.0));
  return {r, portable::tanh(z - reach), portable::tanh(z + reach)};
}

}  // namespace

Estimate rank_correlation(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const auto rows = static_cast<std::size_t>(one.size());
  const Distribution a(one.array().isFinite().select(other.array(), no_statistic).matrix().eval());
  const Distribution b(other.array().isFinite().select(one.array(), no_statistic).matrix().eval());
  return correlation_of(ranks_of(a.values(), a.grains(), rows),
                        ranks_of(b.values(), b.grains(), rows), a.size());
}

SampleStatistics measure_sample(const GrainSample& sample, const SampleOptions& options,
                                const Execution& execution) {
  const std::size_t grains = sample.grains.size();
  execution.report(0.0, "Measuring the sample");
  std::vector<Repeated> all(sample.columns.size() + 1);
  execution.parallel_for_each(all.size(), 1, [&](std::size_t k) {
    const auto column = static_cast<Eigen::Index>(k) - 1;
    all[k] = Repeated(k == 0 ? sample.sizes : Eigen::VectorXd(sample.values.col(column)),
                      sample.masses, k == 0);
  });
  SampleStatistics statistics;
  statistics.repetitions = options.repetitions_for(grains, most_grains_at_full);
  const std::vector<Estimate> estimates = bootstrap(
      all, grains, static_cast<std::size_t>(statistics.repetitions), options.seed, execution);
  const Estimate* at = estimates.data();
  statistics.size_by_number = size_estimates(at);
  statistics.size_by_mass = size_estimates(at + size_numbers);
  at += 2 * size_numbers;
  const std::vector<double> size_ranks = ranks_of(all[0].values(), all[0].grains(), grains);
  for (std::size_t k = 0; k < sample.columns.size(); ++k, at += 2 * column_numbers) {
    const std::vector<double>& values = all[k + 1].values();
    ColumnStatistics column;
    column.column = sample.columns[k];
    column.count = values.size();
    column.smallest = values.empty() ? no_statistic : values.front();
    column.largest = values.empty() ? no_statistic : values.back();
    column.by_number = column_estimates(at);
    column.by_mass = column_estimates(at + column_numbers);
    // If all grains have the descriptor, the ranks of their sizes are known.
    column.size_correlation =
        values.size() == grains
            ? correlation_of(size_ranks, ranks_of(values, all[k + 1].grains(), grains), grains)
            : rank_correlation(sample.sizes, sample.values.col(k));
    statistics.columns.push_back(column);
  }
  for (const double mass : sample.masses) statistics.mass += mass;
  return statistics;
}

std::vector<VoxelTrend> voxel_trends(const GrainSample& sample) {
  std::vector<VoxelTrend> trends;
  if (sample.voxels_across.size() == 0) return trends;
  const Eigen::Array<bool, Eigen::Dynamic, 1> is_trusted =
      sample.voxels_across.array() >= least_trusted_across;
  for (std::size_t k = 0; k < sample.columns.size(); ++k) {
    // Lengths grow with the size anyway.
    if (!sample.columns[k].unit.empty()) continue;
    const Eigen::VectorXd corrected = sample.corrected.col(k);
    const Eigen::Array<bool, Eigen::Dynamic, 1> is_resolved = corrected.array().isFinite();
    const Eigen::VectorXd raw = is_resolved.select(sample.values.col(k).array(), no_statistic);
    const Eigen::VectorXd trusted = is_trusted.select(corrected.array(), no_statistic);
    VoxelTrend trend;
    trend.name = sample.columns[k].name;
    trend.count = is_resolved.count();
    trend.trusted_count = (is_resolved && is_trusted).count();
    if (trend.count == 0) continue;
    trend.raw = rank_correlation(sample.sizes, raw);
    trend.corrected = rank_correlation(sample.sizes, corrected);
    trend.trusted = rank_correlation(sample.sizes, trusted);
    trends.push_back(trend);
  }
  return trends;
}

}  // namespace wscvt
