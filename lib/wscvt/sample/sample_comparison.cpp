// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sample/sample_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "wscvt/sample/random_stream.h"

namespace wscvt {

namespace {

constexpr double no_comparison = std::numeric_limits<double>::quiet_NaN();
/// A parting costs n for each descriptor: above this many grains fewer are made.
constexpr std::size_t most_grains_permuted = 4000;
constexpr int least_permutations = 200;

/// Two samples in one ascending list.
class Pooled {
 public:
  Pooled(const Distribution& one, const Distribution& other) : of_one_(one.size()) {
    const std::size_t n = one.size() + other.size();
    Eigen::VectorXd values(static_cast<Eigen::Index>(n));
    Eigen::VectorXd weights(static_cast<Eigen::Index>(n));
    const auto put = [&](const Distribution& from, std::size_t at) {
      std::copy(from.values().begin(), from.values().end(), values.data() + at);
      std::copy(from.weights().begin(), from.weights().end(), weights.data() + at);
    };
    put(one, 0);
    put(other, one.size());
    all_ = Distribution(values, weights);
  }

  /// Of grains whose place in the two samples, one after the other, says which they are of.
  SampleDistance distance(const std::vector<std::uint32_t>& places) const {
    double totals[2] = {0.0, 0.0};
    for (std::size_t k = 0; k < all_.size(); ++k) {
      totals[places[all_.grains()[k]] < of_one_ ? 0 : 1] += all_.weights()[k];
    }
    double difference = 0.0;
    SampleDistance result{0.0, 0.0, no_comparison, no_comparison};
    for (std::size_t k = 0; k < all_.size(); ++k) {
      const bool is_one = places[all_.grains()[k]] < of_one_;
      difference += is_one ? all_.weights()[k] / totals[0] : -all_.weights()[k] / totals[1];
      const bool is_last = k + 1 == all_.size();
      const double gap = is_last ? 0.0 : all_.values()[k + 1] - all_.values()[k];
      // Equal values are one step.
      if (!is_last && gap == 0.0) continue;
      if (!is_last) result.kolmogorov = std::max(result.kolmogorov, std::abs(difference));
      result.wasserstein += std::abs(difference) * gap;
    }
    return result;
  }

  std::size_t size() const { return all_.size(); }

 private:
  std::size_t of_one_;
  Distribution all_;
};

std::vector<std::uint32_t> identity(std::size_t count) {
  std::vector<std::uint32_t> places(count);
  std::iota(places.begin(), places.end(), 0U);
  return places;
}

/// Rounding makes partings that are the same differ in their last bits.
bool is_as_far(double parted, double own) { return parted >= own * (1.0 - 1e-12); }

std::size_t partings_for(std::size_t grains, int asked) {
  if (grains <= most_grains_permuted || asked <= least_permutations) {
    return static_cast<std::size_t>(asked);
  }
  const double share = static_cast<double>(most_grains_permuted) / static_cast<double>(grains);
  return static_cast<std::size_t>(std::max<double>(least_permutations, asked * share));
}

SampleDistance tested_distance(const Distribution& one, const Distribution& other,
                               const SampleOptions& options, const Execution& execution) {
  SampleDistance own = distance_between(one, other);
  const std::size_t n = one.size() + other.size();
  const std::size_t partings = partings_for(n, options.repetitions);
  if (partings == 0 || one.size() == 0 || other.size() == 0) return own;
  const Pooled pooled(one, other);
  std::vector<std::pair<bool, bool>> farther(partings);
  execution.parallel_for(partings, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      RandomStream random(options.seed, k);
      std::vector<std::uint32_t> places = identity(n);
      for (std::size_t last = n; last > 1; --last) {
        std::swap(places[last - 1], places[random.below(last)]);
      }
      const SampleDistance parted = pooled.distance(places);
      farther[k] = {is_as_far(parted.kolmogorov, own.kolmogorov),
                    is_as_far(parted.wasserstein, own.wasserstein)};
    }
  });
  double kolmogorov = 1.0;
  double wasserstein = 1.0;
  for (const auto& [by_kolmogorov, by_wasserstein] : farther) {
    kolmogorov += by_kolmogorov ? 1.0 : 0.0;
    wasserstein += by_wasserstein ? 1.0 : 0.0;
  }
  own.kolmogorov_p = kolmogorov / static_cast<double>(partings + 1);
  own.wasserstein_p = wasserstein / static_cast<double>(partings + 1);
  return own;
}

}  // namespace

SampleDistance distance_between(const Distribution& one, const Distribution& other) {
  if (one.size() == 0 || other.size() == 0)
    return {no_comparison, no_comparison, no_comparison, no_comparison};
  const Pooled pooled(one, other);
  return pooled.distance(identity(pooled.size()));
}

std::vector<ColumnComparison> compare_samples(const GrainSample& one, const GrainSample& other,
                                              const SampleOptions& options,
                                              const Execution& execution) {
  std::vector<ColumnComparison> rows;
  const auto compare = [&](const GrainColumn& column, const Eigen::VectorXd& a,
                           const Eigen::VectorXd& b) {
    execution.report(0.0, "Comparing the samples");
    const Distribution by_number(a);
    rows.push_back({column, by_number.deviation(),
                    tested_distance(by_number, Distribution(b), options, execution),
                    tested_distance(Distribution(a, one.masses), Distribution(b, other.masses),
                                    options, execution)});
  };
  compare({"size", one.size_unit}, one.sizes, other.sizes);
  for (std::size_t k = 0; k < one.columns.size(); ++k) {
    const auto found =
        std::find_if(other.columns.begin(), other.columns.end(),
                     [&](const GrainColumn& column) { return column.name == one.columns[k].name; });
    if (found == other.columns.end()) continue;
    compare(one.columns[k], one.values.col(static_cast<Eigen::Index>(k)),
            other.values.col(found - other.columns.begin()));
  }
  return rows;
}

}  // namespace wscvt
