// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/sample_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "toolbox/sample/random_stream.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text.h"

namespace wscvt {

namespace {

constexpr double no_comparison = std::numeric_limits<double>::quiet_NaN();
/// The cost of a division per descriptor grows with n: above this many grains fewer are made.
constexpr std::size_t most_grains_permuted = 4000;

/// Divisions that are measured at once: their numbers fill the registers of a processor.
constexpr std::size_t partings_at_once = 4;
using PartingNumbers = std::array<double, partings_at_once>;
/// For each grain of both samples, 1 in each division in which it is in the first sample, else 0.
using Partings = std::vector<std::array<std::uint8_t, partings_at_once>>;

struct PartingDistances {
  PartingNumbers kolmogorov{};
  PartingNumbers wasserstein{};
};

/// Converts a grain's label into its step of the difference of two distribution functions.
struct Step {
  PartingNumbers both{};
  PartingNumbers fall{};
  Step(const PartingNumbers& of_one, double all) {
    for (std::size_t lane = 0; lane < partings_at_once; ++lane) {
      fall[lane] = 1.0 / (all - of_one[lane]);
      both[lane] = 1.0 / of_one[lane] + fall[lane];
    }
  }
};

constexpr double rounding = 1e-12;  // relative

/// One descriptor of two samples in one ascending list.
class PooledColumn {
 public:
  PooledColumn() = default;
  /// A row per grain of both samples, one sample after the other. NaN: missing.
  PooledColumn(const Eigen::VectorXd& values, const Eigen::VectorXd& masses) {
    const Distribution all(values);
    values_ = all.values();
    grains_ = all.grains();
    for (const std::uint32_t grain : grains_) {
      masses_.push_back(masses[grain]);
      mass_ += masses_.back();
    }
  }

  void measure(const Partings& partings, PartingDistances& by_number,
               PartingDistances& by_mass) const {
    PartingNumbers ones{};
    PartingNumbers mass_of_one{};
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const std::array<std::uint8_t, partings_at_once>& is_one = partings[grains_[k]];
      for (std::size_t lane = 0; lane < partings_at_once; ++lane) {
        ones[lane] += is_one[lane];
        mass_of_one[lane] += is_one[lane] * masses_[k];
      }
    }
    const Step step(ones, static_cast<double>(values_.size()));
    const Step mass_step(mass_of_one, mass_);
    PartingNumbers difference{};
    PartingNumbers mass_difference{};
    for (std::size_t k = 0; k + 1 < values_.size(); ++k) {
      const std::array<std::uint8_t, partings_at_once>& is_one = partings[grains_[k]];
      for (std::size_t lane = 0; lane < partings_at_once; ++lane) {
        difference[lane] += is_one[lane] * step.both[lane] - step.fall[lane];
        mass_difference[lane] +=
            masses_[k] * (is_one[lane] * mass_step.both[lane] - mass_step.fall[lane]);
      }
      const double gap = values_[k + 1] - values_[k];
      // Equal values make one step, also those that differ by rounding: remeshes with one volume.
      if (gap <= rounding * std::abs(values_[k + 1])) continue;
      add(difference, gap, by_number);
      add(mass_difference, gap, by_mass);
    }
    for (std::size_t lane = 0; lane < partings_at_once; ++lane) {
      if (!std::isfinite(step.both[lane])) clear(by_number, lane);
      if (!std::isfinite(mass_step.both[lane])) clear(by_mass, lane);
    }
  }

 private:
  static void add(const PartingNumbers& difference, double gap, PartingDistances& distances) {
    for (std::size_t lane = 0; lane < partings_at_once; ++lane) {
      const double size = std::abs(difference[lane]);
      distances.kolmogorov[lane] = std::max(distances.kolmogorov[lane], size);
      distances.wasserstein[lane] += size * gap;
    }
  }

  /// For a division with an empty part.
  static void clear(PartingDistances& distances, std::size_t lane) {
    distances.kolmogorov[lane] = distances.wasserstein[lane] = no_comparison;
  }

  std::vector<double> values_;
  std::vector<double> masses_;
  std::vector<std::uint32_t> grains_;
  double mass_ = 0.0;
};

/// Returns the given samples, in every lane.
Partings as_given(std::size_t of_one, std::size_t all) {
  Partings partings(all, {0, 0, 0, 0});
  std::fill_n(partings.begin(), of_one, std::array<std::uint8_t, partings_at_once>{1, 1, 1, 1});
  return partings;
}

/// Divides randomly into as many grains, each division from its own stream.
void part(std::uint64_t seed, std::size_t first_stream, std::size_t of_one, Partings& partings) {
  std::vector<std::uint8_t> is_one(partings.size());
  for (std::size_t lane = 0; lane < partings_at_once; ++lane) {
    std::fill(is_one.begin(), is_one.end(), std::uint8_t{0});
    std::fill_n(is_one.begin(), of_one, std::uint8_t{1});
    RandomStream random(seed, first_stream + lane);
    for (std::size_t last = is_one.size(); last > 1; --last) {
      std::swap(is_one[last - 1], is_one[random.below(last)]);
    }
    for (std::size_t k = 0; k < is_one.size(); ++k) partings[k][lane] = is_one[k];
  }
}

/// Rounding makes equal divisions differ in their last bits.
bool is_as_far(double parted, double own) { return parted >= own * (1.0 - rounding); }

SampleDistance first_lane(const PartingDistances& distances) {
  return {distances.kolmogorov[0], distances.wasserstein[0], no_comparison, no_comparison};
}

/// Number of divisions of a column that are at least as far apart as the samples: by number, then
/// by mass; first Kolmogorov's distance, then Wasserstein's.
using Farther = std::array<std::uint32_t, 4>;

/// Counts over the first `count` divisions.
void count_farther(const PartingDistances& parted, const SampleDistance& own, std::size_t count,
                   std::uint32_t* farther) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    farther[0] += is_as_far(parted.kolmogorov[lane], own.kolmogorov) ? 1 : 0;
    farther[1] += is_as_far(parted.wasserstein[lane], own.wasserstein) ? 1 : 0;
  }
}

/// Computes p for the rows, which have the samples' own distances.
void test_rows(const std::vector<PooledColumn>& columns, std::size_t of_one, std::size_t all,
               const SampleOptions& options, const Execution& execution,
               std::vector<ColumnComparison>& rows) {
  const auto partings =
      static_cast<std::size_t>(options.repetitions_for(all, most_grains_permuted));
  if (partings == 0) return;
  const std::size_t groups = (partings + partings_at_once - 1) / partings_at_once;
  std::vector<Farther> farther(groups * columns.size(), Farther{});
  execution.parallel_for(groups, 1, [&](std::size_t begin, std::size_t end) {
    Partings parted(all);
    for (std::size_t group = begin; group < end; ++group) {
      part(options.seed, group * partings_at_once, of_one, parted);
      const std::size_t count = std::min(partings_at_once, partings - group * partings_at_once);
      for (std::size_t k = 0; k < columns.size(); ++k) {
        PartingDistances by_number;
        PartingDistances by_mass;
        columns[k].measure(parted, by_number, by_mass);
        Farther& counted = farther[group * columns.size() + k];
        count_farther(by_number, rows[k].by_number, count, counted.data());
        count_farther(by_mass, rows[k].by_mass, count, counted.data() + 2);
      }
    }
  });
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Farther sum{};
    for (std::size_t group = 0; group < groups; ++group) {
      for (std::size_t one = 0; one < sum.size(); ++one) {
        sum[one] += farther[group * columns.size() + k][one];
      }
    }
    // The samples themselves count as a division too.
    const auto p = [&](std::uint32_t count) {
      return (1.0 + count) / static_cast<double>(partings + 1);
    };
    ColumnComparison& row = rows[k];
    if (std::isnan(row.by_number.kolmogorov)) continue;
    row.by_number.kolmogorov_p = p(sum[0]);
    row.by_number.wasserstein_p = p(sum[1]);
    if (std::isnan(row.by_mass.kolmogorov)) continue;
    row.by_mass.kolmogorov_p = p(sum[2]);
    row.by_mass.wasserstein_p = p(sum[3]);
  }
}

Eigen::VectorXd joined(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  Eigen::VectorXd both(one.size() + other.size());
  both << one, other;
  return both;
}

/// A descriptor of two samples.
struct ColumnPair {
  GrainColumn column;
  Eigen::VectorXd one;
  Eigen::VectorXd other;
};

/// Refuses to compare different units, such as millimetres and micrometres.
void check_units(const GrainColumn& one, const GrainColumn& other) {
  const auto is_open = [](const std::string& unit) {
    return unit.empty() || unit.rfind("length", 0) == 0;
  };
  if (is_open(one.unit) || is_open(other.unit) || one.unit == other.unit) return;
  refuse("\"" + one.name + "\" is in " + readable(one.unit, "") + " in the first sample and in " +
         readable(other.unit, "") +
         " in the second. Convert the columns of one table, and name the unit in their headings.");
}

/// Refuses masses that may have two units: random divisions mix the grains of both samples.
void check_masses(const GrainSample& one, const GrainSample& other) {
  check_units(one.mass_column, other.mass_column);
  if (one.mass_column.name == other.mass_column.name) return;
  const auto source = [](const GrainSample& sample) {
    return sample.mass_column.name.empty() ? "the volumes"
                                           : "the column \"" + sample.mass_column.name + "\"";
  };
  refuse("Masses are from " + source(one) + " in the first sample and from " + source(other) +
         " in the second, which may be two units. Give both tables the column, or give " +
         mention("density") + ", so that both have masses from volumes.");
}

/// Returns the descriptors that both samples have.
std::vector<ColumnPair> shared_columns(const GrainSample& one, const GrainSample& other) {
  std::vector<ColumnPair> pairs = {{{"size", one.size_unit}, one.sizes, other.sizes}};
  check_units(pairs[0].column, {"size", other.size_unit});
  for (std::size_t k = 0; k < one.columns.size(); ++k) {
    const auto found = find_column(other.columns, one.columns[k].name);
    if (!found) continue;
    check_units(one.columns[k], other.columns[*found]);
    pairs.push_back({one.columns[k], one.values.col(k), other.values.col(*found)});
  }
  return pairs;
}

}  // namespace

double ColumnComparison::in_deviations(const SampleDistance& distance) const {
  return deviation > 0.0 ? distance.wasserstein / deviation : no_comparison;
}

SampleDistance distance_between(const Distribution& one, const Distribution& other) {
  const auto mapped = [](const std::vector<double>& numbers) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(), numbers.size());
  };
  const PooledColumn pooled(joined(mapped(one.values()), mapped(other.values())),
                            joined(mapped(one.weights()), mapped(other.weights())));
  PartingDistances by_number;
  PartingDistances by_weight;
  pooled.measure(as_given(one.size(), one.size() + other.size()), by_number, by_weight);
  return first_lane(by_weight);
}

std::vector<ColumnComparison> compare_samples(const GrainSample& one, const GrainSample& other,
                                              const SampleOptions& options,
                                              const Execution& execution) {
  execution.report(0.0, "Comparing the samples");
  check_masses(one, other);
  const std::vector<ColumnPair> pairs = shared_columns(one, other);
  const std::size_t of_one = one.grains.size();
  const std::size_t all = of_one + other.grains.size();
  const Partings given = as_given(of_one, all);
  const Eigen::VectorXd masses = joined(one.masses, other.masses);
  std::vector<ColumnComparison> rows(pairs.size());
  std::vector<PooledColumn> columns(pairs.size());
  execution.parallel_for_each(pairs.size(), 1, [&](std::size_t k) {
    const ColumnPair& pair = pairs[k];
    columns[k] = PooledColumn(joined(pair.one, pair.other), masses);
    PartingDistances by_number;
    PartingDistances by_mass;
    columns[k].measure(given, by_number, by_mass);
    rows[k] = {pair.column, Distribution(pair.one).deviation(), first_lane(by_number),
               first_lane(by_mass)};
  });
  test_rows(columns, of_one, all, options, execution, rows);
  return rows;
}

}  // namespace wscvt
