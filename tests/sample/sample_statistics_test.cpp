// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/sample_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "support/holds.h"
#include "support/plain_statistics.h"
#include "toolbox/sample/distribution.h"
#include "toolbox/sample/random_stream.h"
#include "toolbox/sample/sample_comparison.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"

namespace wscvt {
namespace {

using test::holds;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Numbers in [0, 1).
Eigen::VectorXd uniform(Eigen::Index count, std::uint64_t seed) {
  RandomStream random(seed, 1000);
  Eigen::VectorXd values(count);
  for (double& value : values) value = random.uniform();
  return values;
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// A table of scans whose sizes are those given, and whose volumes are the sizes' cubes.
GrainTable table_of(const Eigen::VectorXd& sizes) {
  GrainTable table;
  table.columns = {
      {"nodes", ""},          {"scan.volume", "length^3"},   {"scan.axis_i_box", "length"},
      {"scan.convexity", ""}, {"scan.centroid_x", "length"}, {"remesh.axis_i_box", "length"}};
  table.values.resize(sizes.size(), 6);
  table.values.col(1) = sizes.array().cube();
  table.values.col(2) = sizes;
  table.values.col(3) = 1.0 - 0.5 * uniform(sizes.size(), 77).array();
  table.values.col(5) = 2.0 * sizes;
  for (Eigen::Index k = 0; k < sizes.size(); ++k) table.grains.push_back(std::to_string(k));
  return table;
}

GrainSample sample_with(const Eigen::VectorXd& sizes, const SampleOptions& options = {}) {
  return sample_of(table_of(sizes), options);
}

// A grain without a mass would count by number and not by mass.
TEST(GrainSample, LeavesOutGrainsWithoutAMass) {
  GrainTable table = table_of(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  for (const double volume : {no_value, 0.0, std::numeric_limits<double>::infinity()}) {
    table.values(1, 1) = volume;
    const GrainSample sample = sample_of(table, {});
    EXPECT_EQ(sample.grains, (std::vector<std::string>{"0", "2", "3"}));
    EXPECT_EQ(sample.masses.size(), 3);
    EXPECT_EQ(sample.masses.sum(), 1.0 + 27.0 + 64.0);
    ASSERT_EQ(sample.notes.size(), 1U);
    EXPECT_TRUE(holds(sample.notes[0], "1 grain without a mass"));
  }
}

TEST(GrainSample, NotesWhatTheVoxelsDoNotResolve) {
  GrainTable table = table_of(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  table.columns[0].name = "scan.sq";
  const Eigen::Index columns = table.values.cols();
  table.values.conservativeResize(Eigen::NoChange, columns + 3);
  for (const char* name :
       {"resolution.voxels_across", "resolution.sq.corrected", "resolution.volume.corrected"}) {
    table.columns.push_back({name, ""});
  }
  table.values.col(0).setConstant(0.1);
  table.values.col(columns).setConstant(20.0);
  table.values.col(columns + 1).setConstant(no_value);
  table.values.col(columns + 2) = Eigen::Vector4d(1.0, no_value, 27.0, 64.0);
  SampleOptions options;
  options.of = SampledMesh::Scan;
  const GrainSample sample = sample_of(table, options);
  ASSERT_EQ(sample.notes.size(), 1U);
  EXPECT_TRUE(holds(sample.notes[0], "sq of all grains"));
  EXPECT_TRUE(holds(sample.notes[0], "volume of 1 of 4 grains"));
}

TEST(GrainSample, TakesTheColumnsOfOneMesh) {
  const Eigen::Vector4d sizes(1.0, no_value, 3.0, 2.0);
  SampleOptions options;
  options.density = 7.0;
  const GrainSample scans = sample_with(sizes, options);
  EXPECT_EQ(scans.grains, (std::vector<std::string>{"0", "2", "3"}));
  ASSERT_EQ(scans.columns.size(), 3U);  // no position
  EXPECT_EQ(scans.columns[0].name, "volume");
  EXPECT_EQ(scans.size_unit, "length");
  EXPECT_EQ(scans.sizes[1], 3.0);
  EXPECT_EQ(scans.masses[1], 7.0 * 27.0);
  ASSERT_EQ(scans.notes.size(), 1U);
  EXPECT_TRUE(holds(scans.notes[0], "1 grain without a size"));
  options.of = SampledMesh::Remesh;
  const GrainSample remeshes = sample_with(sizes, options);
  ASSERT_EQ(remeshes.columns.size(), 1U);
  EXPECT_EQ(remeshes.sizes[1], 6.0);
  // Without a volume masses are those of spheres.
  EXPECT_NEAR(remeshes.masses[1], 7.0 * pi / 6.0 * 216.0, 1e-9);
  options.size = SizeMeasure::LargestFeret;
  EXPECT_THROW(sample_with(sizes, options), Error);
  EXPECT_THROW(sample_with(Eigen::Vector2d(1.0, no_value)), Error);
}

TEST(GrainSample, TakesMassesOrDensitiesOfTheTable) {
  GrainTable table = table_of(Eigen::Vector3d(1.0, 2.0, 3.0));
  table.columns[0].name = "density";
  table.values.col(0) = Eigen::Vector3d(7.0, 5.0, 2.0);
  GrainSample sample = sample_of(table, {});
  EXPECT_EQ(sample.masses, Eigen::Vector3d(7.0, 40.0, 54.0));
  EXPECT_TRUE(std::isnan(sample.density));
  ASSERT_EQ(sample.notes.size(), 1U);
  EXPECT_TRUE(holds(sample.notes[0], "\"density\""));
  table.columns[4].name = "mass";
  table.values.col(4) = Eigen::Vector3d(0.5, 0.25, 4.0);
  EXPECT_EQ(sample_of(table, {}).masses, Eigen::Vector3d(0.5, 0.25, 4.0));
  SampleOptions options;
  options.density = 2.0;  // what is typed counts
  EXPECT_EQ(sample_of(table, options).masses, Eigen::Vector3d(2.0, 16.0, 54.0));
}

TEST(GrainSample, TakesSizesOfVolumes) {
  GrainTable table;
  table.columns = {{"volume", "mm^3"}, {"convexity", ""}};
  table.values.resize(2, 2);
  table.values << 4.0 / 3.0 * pi * 27.0, 0.9, 4.0 / 3.0 * pi * 0.125, 0.8;
  table.grains = {"a", "b"};
  SampleOptions options;
  options.size = SizeMeasure::EquivalentDiameter;
  const GrainSample sample = sample_of(table, options);
  EXPECT_NEAR(sample.sizes[0], 6.0, 1e-12);
  EXPECT_NEAR(sample.sizes[1], 1.0, 1e-12);
  EXPECT_EQ(sample.size_unit, "mm");
  EXPECT_EQ(sample.notes, std::vector<std::string>{"Sizes are from the column \"volume\"."});
}

// The resolution is the scans'.
TEST(GrainSample, OfRemeshesHasNoVoxels) {
  GrainTable table = table_of(Eigen::Vector3d(1.0, 2.0, 3.0));
  table.columns[0].name = "resolution.voxels_across";
  table.values.col(0).setConstant(9.0);
  SampleOptions options;
  EXPECT_EQ(sample_of(table, options).voxels_across.size(), 3);
  options.of = SampledMesh::Remesh;
  EXPECT_EQ(sample_of(table, options).voxels_across.size(), 0);
}

TEST(SampleComparison, RefusesTwoUnits) {
  SampleOptions options;
  options.repetitions = 0;
  GrainSample one = sample_with(Eigen::Vector3d(1.0, 2.0, 3.0));
  GrainSample other = one;
  other.columns[1].unit = "mm";  // against "length", which may be any
  EXPECT_NO_THROW(compare_samples(one, other, options, Execution(1)));
  one.columns[1].unit = "um";
  EXPECT_THROW(compare_samples(one, other, options, Execution(1)), Error);
  one = other;
  one.size_unit = "um";  // of other columns than those that both have
  other.size_unit = "mm";
  EXPECT_THROW(compare_samples(one, other, options, Execution(1)), Error);
  other.size_unit = "um";
  EXPECT_NO_THROW(compare_samples(one, other, options, Execution(1)));
  // Masses of a balance are in any unit.
  one.mass_column = {"mass", ""};
  EXPECT_THROW(compare_samples(one, other, options, Execution(1)), Error);
  other.mass_column = {"mass", "g"};
  EXPECT_NO_THROW(compare_samples(one, other, options, Execution(1)));
  one.mass_column.unit = "mg";
  EXPECT_THROW(compare_samples(one, other, options, Execution(1)), Error);
  other.mass_column = one.mass_column = {"density", ""};
  EXPECT_NO_THROW(compare_samples(one, other, options, Execution(1)));
}

TEST(SampleStatistics, SizesOfAUniformSampleAreItsShares) {
  // Sizes 0.5, 1.5, ..., 999.5: by number D10 is 100; by mass (cubes) D10 is 1000 * 0.1^(1/4).
  const Eigen::VectorXd sizes = Eigen::VectorXd::LinSpaced(1000, 0.5, 999.5);
  SampleOptions options;
  options.repetitions = 0;
  const SampleStatistics s = measure_sample(sample_with(sizes, options), options, Execution(1));
  EXPECT_NEAR(s.size_by_number.d10.value, 100.0, 1e-9);
  EXPECT_NEAR(s.size_by_number.d60.value, 600.0, 1e-9);
  EXPECT_NEAR(s.size_by_number.uniformity.value, 6.0, 1e-9);
  EXPECT_NEAR(s.size_by_number.curvature.value, 300.0 * 300.0 / (100.0 * 600.0), 1e-9);
  // A sum in place of an integral: half a grain.
  EXPECT_NEAR(s.size_by_mass.d10.value, 1000.0 * std::pow(0.1, 0.25), 0.1);
  EXPECT_NEAR(s.size_by_mass.d50.value, 1000.0 * std::pow(0.5, 0.25), 0.1);
  EXPECT_TRUE(std::isnan(s.size_by_mass.d50.lower));
  ASSERT_EQ(s.columns.size(), 3U);
  const ColumnStatistics& size = s.columns[1];
  EXPECT_EQ(size.count, 1000U);
  EXPECT_EQ(size.smallest, 0.5);
  EXPECT_EQ(size.largest, 999.5);
  EXPECT_NEAR(size.by_number.mean.value, 500.0, 1e-9);
  // Variance (n^2 - 1) / 12 over n, here over n - 1.
  EXPECT_NEAR(size.by_number.deviation.value, std::sqrt(999999.0 / 12.0 * 1000.0 / 999.0), 1e-9);
  EXPECT_NEAR(size.by_mass.mean.value, 800.0, 0.1);
  EXPECT_NEAR(size.size_correlation.value, 1.0, 1e-12);
}

TEST(SampleStatistics, IntervalsHoldTheTruthAsOftenAsTheySay) {
  // Uniform sizes; 200 samples of 60: of 95 % intervals 190 are to hold the mean, and 4 deviations
  // of the binomial are 12. Percentile intervals of 60 grains are 1 to 2 % short.
  int held_mean = 0;
  int held_median = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    SampleOptions options;
    options.seed = k;
    options.repetitions = 200;
    const SampleStatistics s = measure_sample(
        sample_with(uniform(60, k + 500).array() + 1.0, options), options, Execution(1));
    const ColumnEstimates& size = s.columns[1].by_number;
    held_mean += size.mean.lower <= 1.5 && 1.5 <= size.mean.upper ? 1 : 0;
    held_median += size.median.lower <= 1.5 && 1.5 <= size.median.upper ? 1 : 0;
  }
  EXPECT_NEAR(held_mean, 188, 14);
  EXPECT_NEAR(held_median, 188, 14);
}

TEST(SampleStatistics, TheIntervalOfAMeanIsThatOfTheNormalDistribution) {
  SampleOptions options;
  options.repetitions = 2000;
  const SampleStatistics s =
      measure_sample(sample_with(uniform(400, 3).array() + 1.0), options, Execution(2));
  const ColumnEstimates& size = s.columns[1].by_number;
  const double reach = 1.96 * size.deviation.value / 20.0;
  // Ends of 2000 repetitions scatter by 4 %.
  EXPECT_NEAR(size.mean.upper - size.mean.value, reach, 0.15 * reach);
  EXPECT_NEAR(size.mean.value - size.mean.lower, reach, 0.15 * reach);
}

/// 602 grains, so that sums have several blocks; some without a value. Large grains may be light.
GrainSample gapped_sample() {
  GrainTable table = table_of(uniform(604, 21).array() + 0.5);
  table.values.col(1).reverseInPlace();
  table.values(603, 3) = table.values(5, 3) = no_value;
  table.values(600, 1) = table.values(17, 1) = no_value;  // no mass: left out
  table.values.col(3).segment(100, 40).setConstant(0.75);
  return sample_of(table, {});
}

TEST(SampleStatistics, EveryNumberIsThatOfItsDefinition) {
  const GrainSample sample = gapped_sample();
  SampleOptions options;
  options.repetitions = 0;
  const SampleStatistics s = measure_sample(sample, options, Execution(1));
  const auto expect = [](const ColumnEstimates& found, const test::PlainStatistics& plain) {
    EXPECT_NEAR(found.mean.value, plain.mean(), 1e-12 * std::abs(plain.mean()));
    EXPECT_NEAR(found.deviation.value, plain.deviation(), 1e-12 * plain.deviation());
    EXPECT_NEAR(found.percent_10.value, plain.quantile(0.1), 1e-12);
    EXPECT_NEAR(found.median.value, plain.quantile(0.5), 1e-12);
    EXPECT_NEAR(found.percent_90.value, plain.quantile(0.9), 1e-12);
  };
  ASSERT_EQ(s.columns.size(), sample.columns.size());
  for (std::size_t k = 0; k < s.columns.size(); ++k) {
    SCOPED_TRACE(sample.columns[k].name);
    const Eigen::VectorXd values = sample.values.col(static_cast<Eigen::Index>(k));
    const test::PlainStatistics by_number(values);
    expect(s.columns[k].by_number, by_number);
    expect(s.columns[k].by_mass, test::PlainStatistics(values, sample.masses));
    EXPECT_EQ(s.columns[k].count, by_number.grains().size());
    EXPECT_EQ(s.columns[k].smallest, by_number.grains().front().first);
    EXPECT_EQ(s.columns[k].largest, by_number.grains().back().first);
    EXPECT_NEAR(s.columns[k].size_correlation.value,
                test::plain_rank_correlation(sample.sizes, values), 1e-12);
  }
  for (const auto& [found, plain] :
       {std::pair(s.size_by_number, test::PlainStatistics(sample.sizes)),
        std::pair(s.size_by_mass, test::PlainStatistics(sample.sizes, sample.masses))}) {
    const double d10 = plain.quantile(0.1), d30 = plain.quantile(0.3), d60 = plain.quantile(0.6);
    EXPECT_NEAR(found.d10.value, d10, 1e-12);
    EXPECT_NEAR(found.d30.value, d30, 1e-12);
    EXPECT_NEAR(found.d50.value, plain.quantile(0.5), 1e-12);
    EXPECT_NEAR(found.d60.value, d60, 1e-12);
    EXPECT_NEAR(found.d90.value, plain.quantile(0.9), 1e-12);
    EXPECT_NEAR(found.uniformity.value, d60 / d10, 1e-12);
    EXPECT_NEAR(found.curvature.value, d30 * d30 / (d10 * d60), 1e-12);
  }
  EXPECT_NEAR(s.mass, sample.masses.sum(), 1e-12 * s.mass);
}

TEST(SampleStatistics, FewerRepetitionsAreMadeOfVeryManyGrains) {
  SampleOptions options;
  options.repetitions = 1000;
  const auto made = [&](Eigen::Index grains) {
    return measure_sample(sample_with(uniform(grains, 4).array() + 1.0), options, Execution(2))
        .repetitions;
  };
  EXPECT_EQ(made(100), 1000);
  options.repetitions = 240;
  EXPECT_EQ(made(20000), 240);
  EXPECT_EQ(made(22000), 218);  // 240 * 20,000 / 22,000
  EXPECT_EQ(made(60000), 200);  // at least
  options.repetitions = 3;
  EXPECT_EQ(made(60000), 3);
}

TEST(RankCorrelation, HasTheIntervalOfBonettAndWright) {
  Eigen::VectorXd one = uniform(40, 5);
  Eigen::VectorXd other = one + 0.7 * uniform(40, 6);
  one[3] = no_value;
  other[17] = no_value;
  const Estimate r = rank_correlation(one, other);
  EXPECT_NEAR(r.value, test::plain_rank_correlation(one, other), 1e-12);
  // 38 rows have both numbers.
  const double reach = 1.959963984540054 * std::sqrt((1.0 + 0.5 * r.value * r.value) / 35.0);
  EXPECT_NEAR(r.lower, std::tanh(std::atanh(r.value) - reach), 1e-12);
  EXPECT_NEAR(r.upper, std::tanh(std::atanh(r.value) + reach), 1e-12);
  EXPECT_TRUE(std::isnan(rank_correlation(uniform(3, 1), uniform(3, 2)).value));
  EXPECT_FALSE(std::isnan(rank_correlation(uniform(4, 1), uniform(4, 2)).value));
}

/// The middle 95 % of repetitions that are made here one by one.
TEST(SampleStatistics, IntervalsAreThoseOfEachDraw) {
  const GrainSample sample = gapped_sample();
  SampleOptions options;
  options.repetitions = 7;
  options.seed = 12;
  const SampleStatistics s = measure_sample(sample, options, Execution(2));
  const Eigen::VectorXd& values = sample.values.col(2);
  std::vector<std::vector<double>> drawn(5);
  for (std::uint64_t k = 0; k < 7; ++k) {
    RandomStream random(options.seed, k);
    Eigen::VectorXd times = Eigen::VectorXd::Zero(602);
    for (int draw = 0; draw < 602; ++draw) {
      times[static_cast<Eigen::Index>(random.below(602))] += 1.0;
    }
    // A grain that came twice is two grains.
    std::vector<Eigen::Index> grains;
    for (Eigen::Index grain = 0; grain < 602; ++grain) {
      grains.insert(grains.end(), static_cast<std::size_t>(times[grain]), grain);
    }
    const Eigen::VectorXd masses = sample.masses(grains);
    const Distribution by_number(values(grains));
    const Distribution by_mass(values(grains), masses);
    const Distribution sizes(sample.sizes(grains), masses);
    drawn[0].push_back(by_number.quantile(0.9));
    drawn[1].push_back(by_mass.quantile(0.5));
    drawn[2].push_back(by_mass.mean());
    drawn[3].push_back(std::pow(sizes.quantile(0.3), 2) /
                       (sizes.quantile(0.1) * sizes.quantile(0.6)));
    drawn[4].push_back(test::PlainStatistics(values(grains), masses).deviation());
  }
  const ColumnStatistics& column = s.columns[2];
  const Estimate estimates[] = {column.by_number.percent_90, column.by_mass.median,
                                column.by_mass.mean, s.size_by_mass.curvature,
                                column.by_mass.deviation};
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    const Distribution all(drawn[k]);
    EXPECT_NEAR(estimates[k].lower, all.quantile(0.025), 1e-12) << k;
    EXPECT_NEAR(estimates[k].upper, all.quantile(0.975), 1e-12) << k;
  }
  EXPECT_EQ(column.count, 600U);
}

TEST(SampleStatistics, DeviationOfADrawCountsAGrainAsOftenAsItCame) {
  // Of two grains a draw has both, or one twice; then the deviation is 0, and by number the two
  // others' is |difference| / sqrt(2).
  SampleOptions options;
  options.repetitions = 100;
  const SampleStatistics s =
      measure_sample(sample_with(Eigen::Vector2d(1.0, 3.0), options), options, Execution(1));
  EXPECT_EQ(s.columns[1].by_number.deviation.lower, 0.0);
  EXPECT_NEAR(s.columns[1].by_number.deviation.upper, std::sqrt(2.0), 1e-14);
}

TEST(SampleStatistics, HaveTheSameBytesOnAnyNumberOfThreads) {
  const GrainSample sample = sample_with(uniform(50, 9).array() + 1.0);
  const GrainSample other = sample_with(uniform(40, 10).array() + 1.1);
  SampleOptions options;
  options.repetitions = 50;
  const auto numbers = [&](int threads) {
    const SampleStatistics s = measure_sample(sample, options, Execution(threads));
    std::vector<double> all = {s.size_by_mass.d10.lower, s.size_by_mass.curvature.upper};
    for (const ColumnStatistics& column : s.columns) {
      all.push_back(column.by_mass.deviation.lower);
      all.push_back(column.by_number.percent_90.upper);
    }
    for (const ColumnComparison& row :
         compare_samples(sample, other, options, Execution(threads))) {
      all.push_back(row.by_mass.wasserstein_p);
      all.push_back(row.by_number.kolmogorov);
    }
    return all;
  };
  const std::vector<double> one = numbers(1);
  for (const int threads : {2, 5}) {
    const std::vector<double> more = numbers(threads);
    ASSERT_EQ(more.size(), one.size());
    EXPECT_EQ(std::memcmp(more.data(), one.data(), one.size() * sizeof(double)), 0) << threads;
  }
  options.seed = 2;
  EXPECT_NE(numbers(1), one);
}

TEST(RankCorrelation, IsSpearmansWithTies) {
  // Ranks 1, 2.5, 2.5, 4, 5 against 5, 4, 3, 2, 1: sums of the deviations' products -9.5, squares
  // 9.5 and 10.
  Eigen::VectorXd one(6);
  one << 1.0, 20.0, 20.0, 300.0, 4000.0, no_value;
  Eigen::VectorXd other(6);
  other << 9.0, 8.0, 7.0, 6.0, -5.0, 1.0;
  const Estimate r = rank_correlation(one, other);
  EXPECT_NEAR(r.value, -9.5 / std::sqrt(9.5 * 10.0), 1e-14);
  EXPECT_LT(r.lower, r.value);
  EXPECT_GT(r.upper, r.value);
  EXPECT_TRUE(std::isnan(rank_correlation(Eigen::VectorXd::Ones(9), uniform(9, 1)).value));
}

// Each trend against the ranks of its own grains.
TEST(VoxelTrends, AreOfTheGrainsThatAreResolvedAndOfThoseThatAreTrusted) {
  constexpr Eigen::Index grains = 40;
  GrainSample sample;
  sample.sizes = uniform(grains, 3);
  sample.columns = {{"length", "mm"}, {"sphericity", ""}, {"roundness", ""}, {"none", ""}};
  sample.values.resize(grains, 4);
  sample.corrected.resize(grains, 4);
  for (Eigen::Index k = 0; k < 4; ++k) {
    sample.values.col(k) = uniform(grains, 10 + static_cast<std::uint64_t>(k));
    sample.corrected.col(k) = uniform(grains, 20 + static_cast<std::uint64_t>(k));
  }
  sample.corrected.col(3).setConstant(no_value);
  sample.voxels_across = 30.0 * uniform(grains, 4);
  for (const Eigen::Index k : {2, 5, 30}) sample.corrected(k, 1) = no_value;
  sample.voxels_across[7] = no_value;
  sample.voxels_across[8] = 15.0;
  const std::vector<VoxelTrend> trends = voxel_trends(sample);
  ASSERT_EQ(trends.size(), 2U) << "neither lengths nor what no grain has";
  for (Eigen::Index column : {1, 2}) {
    const VoxelTrend& trend = trends[static_cast<std::size_t>(column - 1)];
    EXPECT_EQ(trend.name, sample.columns[static_cast<std::size_t>(column)].name);
    Eigen::VectorXd raw = sample.values.col(column);
    const Eigen::VectorXd corrected = sample.corrected.col(column);
    Eigen::VectorXd trusted = corrected;
    std::size_t resolved = 0;
    std::size_t trusted_count = 0;
    for (Eigen::Index k = 0; k < grains; ++k) {
      if (std::isnan(corrected[k])) raw[k] = no_value;
      if (!(sample.voxels_across[k] >= 15.0)) trusted[k] = no_value;
      if (std::isfinite(raw[k])) ++resolved;
      if (std::isfinite(trusted[k])) ++trusted_count;
    }
    EXPECT_EQ(trend.count, resolved);
    EXPECT_EQ(trend.trusted_count, trusted_count);
    EXPECT_LT(trusted_count, resolved - 5);
    const auto expected = [&](const Eigen::VectorXd& values) {
      return test::plain_rank_correlation(sample.sizes, values);
    };
    EXPECT_NEAR(trend.raw.value, expected(raw), 1e-12);
    EXPECT_NEAR(trend.corrected.value, expected(corrected), 1e-12);
    EXPECT_NEAR(trend.trusted.value, expected(trusted), 1e-12);
  }
  sample.voxels_across.resize(0);
  EXPECT_TRUE(voxel_trends(sample).empty());
}

TEST(SampleComparison, DistancesOfKnownSamples) {
  const auto of = [](const std::vector<double>& values, const std::vector<double>& weights) {
    const auto n = static_cast<Eigen::Index>(values.size());
    return Distribution(Eigen::Map<const Eigen::VectorXd>(values.data(), n),
                        Eigen::Map<const Eigen::VectorXd>(weights.data(), n));
  };
  // Shares 1/4 and 3/4 at 1 and 3, against 1/2 and 1/2 at 2 and 7: differences 1/4, -1/4, 1/2.
  const SampleDistance far =
      distance_between(of({3.0, 1.0}, {6.0, 2.0}), of({2.0, 7.0}, {5.0, 5.0}));
  EXPECT_NEAR(far.kolmogorov, 0.5, 1e-15);
  EXPECT_NEAR(far.wasserstein, 0.25 * 1.0 + 0.25 * 1.0 + 0.5 * 4.0, 1e-15);
  // Moved by 0.7: Wasserstein's distance is 0.7. Values that are equal in both are one step.
  const Distribution uniform_one(uniform(300, 5));
  EXPECT_NEAR(
      distance_between(uniform_one, Distribution(uniform(300, 5).array() + 0.7)).wasserstein, 0.7,
      1e-12);
  const auto kolmogorov = [](const std::vector<double>& a, const std::vector<double>& b) {
    return distance_between(Distribution(a), Distribution(b)).kolmogorov;
  };
  EXPECT_NEAR(kolmogorov({3, 1, 2}, {2, 1, 3}), 0.0, 1e-15);
  EXPECT_NEAR(kolmogorov({1, 2}, {3, 4, 5}), 1.0, 1e-15);
  EXPECT_NEAR(kolmogorov({1, 2, 3, 4}, {2.5, 3.5}), 0.5, 1e-15);
  EXPECT_NEAR(kolmogorov({1, 1, 1, 2}, {1, 2, 2, 2}), 0.5, 1e-15);
  const SampleDistance none = distance_between(uniform_one, uniform_one);
  EXPECT_NEAR(none.kolmogorov, 0.0, 1e-12);
  EXPECT_NEAR(none.wasserstein, 0.0, 1e-12);
}

// The volumes of two families of remeshes of one sample differ by rounding.
TEST(SampleComparison, RoundingIsNoDistance) {
  SampleOptions options;
  options.repetitions = 99;
  GrainTable table = table_of(uniform(40, 8).array() + 0.5);
  const GrainSample one = sample_of(table, {});
  for (Eigen::Index k = 0; k < 40; ++k) {
    for (Eigen::Index column = 0; column < table.values.cols(); ++column) {
      table.values(k, column) *= 1.0 + (k % 3 == 0 ? 1e-15 : k % 3 == 1 ? -1e-15 : 0.0);
    }
  }
  for (const ColumnComparison& row :
       compare_samples(one, sample_of(table, {}), options, Execution(1))) {
    SCOPED_TRACE(row.column.name);
    for (const SampleDistance* distance : {&row.by_number, &row.by_mass}) {
      EXPECT_NEAR(distance->kolmogorov, 0.0, 1e-12);
      EXPECT_NEAR(distance->wasserstein, 0.0, 1e-12);
      EXPECT_EQ(distance->kolmogorov_p, 1.0);
    }
  }
}

TEST(SampleComparison, EveryRowIsOfItsOwnColumn) {
  SampleOptions options;
  options.repetitions = 0;
  const GrainSample one = gapped_sample();
  const GrainSample other = sample_with(2.0 * uniform(150, 31).array() + 0.2);
  const auto rows = compare_samples(one, other, options, Execution(1));
  ASSERT_EQ(rows.size(), 1 + one.columns.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k) - 1;
    const Eigen::VectorXd a = k == 0 ? one.sizes : Eigen::VectorXd(one.values.col(column));
    const Eigen::VectorXd b = k == 0 ? other.sizes : Eigen::VectorXd(other.values.col(column));
    EXPECT_EQ(rows[k].column.name, k == 0 ? "size" : one.columns[k - 1].name);
    SCOPED_TRACE(rows[k].column.name);
    const auto expect = [](const SampleDistance& found, const test::PlainStatistics& x,
                           const test::PlainStatistics& y) {
      const auto [largest, area] = test::plain_distances(x, y);
      EXPECT_NEAR(found.kolmogorov, largest, 1e-12);
      EXPECT_NEAR(found.wasserstein, area, 1e-12 * (1.0 + area));
    };
    expect(rows[k].by_number, test::PlainStatistics(a), test::PlainStatistics(b));
    expect(rows[k].by_mass, test::PlainStatistics(a, one.masses),
           test::PlainStatistics(b, other.masses));
    EXPECT_NEAR(rows[k].deviation, test::PlainStatistics(a).deviation(), 1e-12 * rows[k].deviation);
  }
}

TEST(SampleComparison, PTellsSamplesOfOneFromThoseOfTwo) {
  SampleOptions options;
  options.repetitions = 99;
  // Of 40 pairs of one population 2 are to be below 0.05; of another, moved by half its width, all.
  int same = 0;
  for (std::uint64_t k = 0; k < 40; ++k) {
    options.seed = k;
    const GrainSample one = sample_with(uniform(50, 2 * k).array() + 1.0);
    const GrainSample other = sample_with(uniform(60, 2 * k + 1).array() + 1.0);
    const auto rows = compare_samples(one, other, options, Execution(1));
    same += rows[0].by_number.wasserstein_p <= 0.05 ? 1 : 0;
    if (k > 3) continue;
    const GrainSample moved = sample_with(uniform(60, 2 * k + 1).array() + 1.5);
    const auto farther = compare_samples(one, moved, options, Execution(1));
    EXPECT_EQ(farther[0].column.name, "size");
    EXPECT_EQ(farther[0].by_number.kolmogorov_p, 0.01);
    EXPECT_EQ(farther[0].by_mass.wasserstein_p, 0.01);
    EXPECT_GT(farther[3].by_number.wasserstein_p, 0.01) << farther[3].column.name;
    // Every column has the distance of its two distributions, and of itself none.
    const SampleDistance by_mass = distance_between(Distribution(one.sizes, one.masses),
                                                    Distribution(moved.sizes, moved.masses));
    EXPECT_NEAR(farther[0].by_mass.wasserstein, by_mass.wasserstein, 1e-12);
    EXPECT_NEAR(farther[0].by_mass.kolmogorov, by_mass.kolmogorov, 1e-12);
    EXPECT_EQ(compare_samples(one, one, options, Execution(1))[0].by_number.wasserstein_p, 1.0);
  }
  EXPECT_LE(same, 7);  // more than 7 of 40 at 0.05: one run in 1,500
}

// Of the ten divisions of five grains into three and two only the samples' own is so far apart.
TEST(SampleComparison, PIsThatOfAllDivisions) {
  SampleOptions options;
  options.repetitions = 4000;
  const auto rows = compare_samples(sample_with(Eigen::Vector3d(1.0, 2.0, 3.0)),
                                    sample_with(Eigen::Vector2d(4.0, 50.0)), options, Execution(1));
  EXPECT_NEAR(rows[0].by_number.wasserstein_p, 0.1, 4.0 * std::sqrt(0.09 / 4000.0));
}

// Of six grains there are twenty divisions into three and three.
TEST(SampleComparison, EachPIsThatOfItsOwnDistance) {
  SampleOptions options;
  options.repetitions = 4000;
  const GrainSample one = sample_with(Eigen::Vector3d(5.6, 4.2, 4.5));
  const GrainSample other = sample_with(Eigen::Vector3d(1.8, 3.6, 4.6));
  const SampleDistance number = compare_samples(one, other, options, Execution(1))[0].by_number;
  const SampleDistance mass = compare_samples(one, other, options, Execution(1))[0].by_mass;
  Eigen::Matrix<double, 6, 2> grains;  // sizes and masses
  grains.topRows<3>() << one.sizes, one.masses;
  grains.bottomRows<3>() << other.sizes, other.masses;
  const auto distances = [&](const std::bitset<6>& in_one) {
    Eigen::Matrix<double, 3, 2> a;
    Eigen::Matrix<double, 3, 2> b;
    for (Eigen::Index k = 0, i = 0, j = 0; k < 6; ++k) {
      (in_one[static_cast<std::size_t>(k)] ? a.row(i++) : b.row(j++)) = grains.row(k);
    }
    const auto [largest, area] =
        test::plain_distances(test::PlainStatistics(a.col(0)), test::PlainStatistics(b.col(0)));
    const auto [largest_mass, area_mass] = test::plain_distances(
        test::PlainStatistics(a.col(0), a.col(1)), test::PlainStatistics(b.col(0), b.col(1)));
    return Eigen::Array4d(largest, area, largest_mass, area_mass);
  };
  const Eigen::Array4d own = distances(std::bitset<6>(0b000111));
  Eigen::Array4d share = Eigen::Array4d::Zero();
  for (unsigned set = 0; set < 64; ++set) {
    const std::bitset<6> in_one(set);
    if (in_one.count() != 3) continue;
    share += (distances(in_one) >= own * (1.0 - 1e-9)).cast<double>() / 20.0;
  }
  const Eigen::Array4d found(number.kolmogorov_p, number.wasserstein_p, mass.kolmogorov_p,
                             mass.wasserstein_p);
  // Four deviations of 4,000 draws. The four differ by a fifth.
  EXPECT_LT((found - share).abs().maxCoeff(), 4.0 * std::sqrt(0.25 / 4000.0)) << found.transpose();
  EXPECT_LT((share - Eigen::Array4d(0.6, 0.4, 1.0, 0.8)).abs().maxCoeff(), 1e-9);
}

TEST(SampleComparison, ColumnsMayStandInAnotherOrder) {
  SampleOptions options;
  options.repetitions = 0;
  const GrainSample one = gapped_sample();
  const GrainSample other = sample_with(2.0 * uniform(150, 31).array() + 0.2);
  GrainSample turned = other;
  std::reverse(turned.columns.begin(), turned.columns.end());
  turned.values = Eigen::MatrixXd(other.values.rowwise().reverse());
  const auto rows = compare_samples(one, other, options, Execution(1));
  const auto found = compare_samples(one, turned, options, Execution(1));
  ASSERT_EQ(found.size(), rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(found[k].column.name, rows[k].column.name);
    EXPECT_EQ(found[k].by_number.wasserstein, rows[k].by_number.wasserstein);
    EXPECT_EQ(found[k].by_mass.kolmogorov, rows[k].by_mass.kolmogorov);
  }
}

TEST(SampleComparison, FewerDivisionsAreMadeOfManyGrains) {
  SampleOptions options;
  options.repetitions = 450;
  const auto p_of = [&](Eigen::Index grains) {
    return compare_samples(sample_with(uniform(grains, 1).array() + 1.0),
                           sample_with(uniform(grains, 2).array() + 3.0), options, Execution(1))[0]
        .by_number.kolmogorov_p;
  };
  // No division is as far apart, so p is that of the samples themselves.
  EXPECT_EQ(p_of(2000), 1.0 / 451.0);
  EXPECT_EQ(p_of(3000), 1.0 / 301.0);  // 450 * 4,000 / 6,000
}

}  // namespace

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

TEST(Distribution, QuantilesLieBetweenTheMiddlesOfTheWeights) {
  // Weights 1, 2, 5 of 8: the middles of the grains lie at 1/16, 4/16 and 11/16.
  const Distribution one(vector_of({7.0, 3.0, 4.0}), vector_of({5.0, 1.0, 2.0}));
  EXPECT_EQ(one.values(), (std::vector<double>{3.0, 4.0, 7.0}));
  EXPECT_EQ(one.grains(), (std::vector<std::uint32_t>{1, 2, 0}));
  EXPECT_NEAR(one.quantile(4.0 / 16.0), 4.0, 1e-15);
  EXPECT_NEAR(one.quantile(7.5 / 16.0), 5.5, 1e-15);
  EXPECT_EQ(one.quantile(0.0), 3.0);
  EXPECT_EQ(one.quantile(0.9), 7.0);
}

TEST(Distribution, OfEqualWeightsIsTheOneByNumber) {
  const Distribution one(vector_of({2.0, 10.0, 4.0, 5.0}));
  EXPECT_NEAR(one.quantile(0.5), 4.5, 1e-15);
  EXPECT_NEAR(one.mean(), 5.25, 1e-15);
  // The squares add up to 34.75, over n - 1.
  EXPECT_NEAR(one.deviation(), std::sqrt(34.75 / 3.0), 1e-14);
  // Their mean, .3 / 3, is not .1.
  EXPECT_EQ(Distribution(vector_of({0.1, 0.1, 0.1})).deviation(), 0.0);
}

TEST(Distribution, AGrainOfTwiceTheWeightCountsAsTwo) {
  const Distribution twice(vector_of({1.0, 6.0}), vector_of({1.0, 2.0}));
  EXPECT_NEAR(twice.mean(), 13.0 / 3.0, 1e-15);
  // sum w d^2 = 100/9 + 2 * 25/9 = 150/9; W - sum w^2 / W = 3 - 5/3.
  EXPECT_NEAR(twice.deviation(), std::sqrt(150.0 / 9.0 / (4.0 / 3.0)), 1e-14);
}

TEST(Distribution, LeavesOutWhatHasNoValueOrNoWeight) {
  const Distribution one(vector_of({missing, 3.0, 5.0, 9.0}), vector_of({1.0, 2.0, missing, 0.0}));
  EXPECT_EQ(one.values(), std::vector<double>{3.0});
  EXPECT_EQ(one.quantile(0.3), 3.0);
  EXPECT_TRUE(std::isnan(one.deviation()));
  EXPECT_TRUE(std::isnan(Distribution().quantile(0.5)));
}

TEST(Quantile, OfValuesIsThatOfTheirDistribution) {
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_EQ(quantile({3.0}, 0.9), 3.0);
  const std::vector<double> values = {1.0, 2.0, 2.0, 3.5, 7.0, 11.0};
  for (const double fraction : {0.0, 0.05, 0.1, 0.25, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(quantile(values, fraction), Distribution(values).quantile(fraction), 1e-14)
        << fraction;
  }
}

}  // namespace
}  // namespace wscvt
