// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "toolbox/sample/grain_sample.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// A statistic of a sample with its 95 % interval; NaN if it does not exist.
struct Estimate {
  double value = 0.0;
  double lower = 0.0;
  double upper = 0.0;
};

/// A descriptor's mean, standard deviation and percentiles, by number or by mass.
struct ColumnEstimates {
  Estimate mean;
  Estimate deviation;  ///< see Distribution::deviation
  Estimate percent_10;
  Estimate median;
  Estimate percent_90;
};

/// One descriptor of a sample.
struct ColumnStatistics {
  GrainColumn column;
  std::size_t count = 0;  ///< grains that have it
  double smallest = 0.0;
  double largest = 0.0;
  ColumnEstimates by_number;
  ColumnEstimates by_mass;
  /// Rank correlation with the size (Spearman 1904), ties by mean ranks; its interval by Fisher's z
  /// with the standard error ((1 + r^2 / 2) / (n - 3))^(1/2) (Bonett and Wright 2000).
  Estimate size_correlation;
};

/// Characteristic sizes: D10 is the size that 10 % of the sample are smaller than.
struct SizeEstimates {
  Estimate d10;
  Estimate d30;
  Estimate d50;
  Estimate d60;
  Estimate d90;
  Estimate uniformity;  ///< Cu = D60 / D10
  Estimate curvature;   ///< Cc = D30^2 / (D10 D60)
};

struct SampleStatistics {
  double mass = 0.0;  ///< of all grains
  SizeEstimates size_by_number;
  SizeEstimates size_by_mass;
  std::vector<ColumnStatistics> columns;  ///< those of the sample
  int repetitions = 0;                    ///< that were made
};

/// Computes statistics of a sample. The intervals are the 2.5 and 97.5 percentiles over random
/// samples of as many grains, drawn from it with replacement (percentile bootstrap; Efron 1979).
/// Above 20,000 grains options.repetitions is reduced, to 200 at least. Equal options give the same
/// bytes on any number of threads.
SampleStatistics measure_sample(const GrainSample& sample, const SampleOptions& options,
                                const Execution& execution);

/// Computes the rank correlation of the rows that have both numbers. NaN for fewer than four such
/// rows, or if all numbers of one vector are equal.
Estimate rank_correlation(const Eigen::VectorXd& one, const Eigen::VectorXd& other);

/// Rank correlations of a descriptor with the size of the grains: does a trend survive without the
/// voxels' error?
struct VoxelTrend {
  std::string name;       ///< of the descriptor, as in GrainSample
  Estimate raw;           ///< of all grains whose descriptor is resolved
  Estimate corrected;     ///< of the same grains, corrected
  Estimate trusted;       ///< corrected, of the grains of least_trusted_across voxels and more
  std::size_t count = 0;  ///< of grains whose descriptor is resolved
  std::size_t trusted_count = 0;  ///< of them, those of least_trusted_across voxels and more
};

/// Returns the trends of the sample's descriptors without a unit; empty if the size of the voxels
/// is not known.
std::vector<VoxelTrend> voxel_trends(const GrainSample& sample);

}  // namespace wscvt
