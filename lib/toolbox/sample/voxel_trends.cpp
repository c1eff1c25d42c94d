// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/voxel_trends.h"

#include <limits>

#include "wscvt/measures/voxel_resolution.h"

namespace wscvt {

std::vector<VoxelTrend> voxel_trends(const GrainSample& sample) {
  std::vector<VoxelTrend> trends;
  if (sample.voxels_across.size() == 0) return trends;
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Array<bool, Eigen::Dynamic, 1> is_trusted =
      sample.voxels_across.array() >= least_trusted_across;
  for (std::size_t k = 0; k < sample.columns.size(); ++k) {
    // Lengths grow with the size anyway.
    if (!sample.columns[k].unit.empty()) continue;
    const Eigen::VectorXd corrected = sample.corrected.col(static_cast<Eigen::Index>(k));
    const Eigen::Array<bool, Eigen::Dynamic, 1> is_resolved = corrected.array().isFinite();
    const Eigen::VectorXd raw =
        is_resolved.select(sample.values.col(static_cast<Eigen::Index>(k)).array(), missing);
    const Eigen::VectorXd trusted = is_trusted.select(corrected.array(), missing);
    VoxelTrend trend;
    trend.name = sample.columns[k].name;
    trend.count = static_cast<std::size_t>(is_resolved.count());
    trend.trusted_count = static_cast<std::size_t>((is_resolved && is_trusted).count());
    if (trend.count == 0) continue;
    trend.raw = rank_correlation(sample.sizes, raw);
    trend.corrected = rank_correlation(sample.sizes, corrected);
    trend.trusted = rank_correlation(sample.sizes, trusted);
    trends.push_back(trend);
  }
  return trends;
}

}  // namespace wscvt
