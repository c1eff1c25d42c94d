// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/option.h"

namespace wscvt {

struct TemplateOptions {
  int count = 20;  ///< grains to be chosen
  std::uint64_t seed = 1;
};

inline constexpr NumberOption<int> template_count_option = {
    "count", "number of templates", 1, 1000, Ends::Both, "grains that represent the sample"};

/// Distances between two distributions of each descriptor (Wasserstein, order 1) over the standard
/// deviation of the descriptor in the sample; no unit.
struct TemplateDistances {
  std::vector<double> by_number;
  std::vector<double> by_mass;
};

/// Real grains that represent a sample.
struct SampleTemplates {
  std::vector<std::size_t> grains;  ///< their rows, ascending; K of them
  /// Weights of the K grains; they sum to 1. By number, the grains have the sample's distributions
  /// of the descriptors; by mass, the distributions in which each grain of the sample counts by its
  /// mass.
  std::vector<double> by_number;
  std::vector<double> by_mass;
  /// For each grain of the sample, the number (0 to K - 1) of the nearest template in the space of
  /// the descriptors.
  std::vector<std::size_t> stands_for;
  TemplateDistances reached;
  TemplateDistances random;  ///< of K random grains of equal weights: the mean of 20 choices
};

/// Chooses K grains of a sample and their weights, so that their distributions of the descriptors,
/// and of the sum and the difference of each two, are close to the sample's: the descriptors then
/// depend on each other as in the sample. One grain is exchanged at a time. The weights are
/// non-negative least squares on the distribution functions, and at last least absolute
/// differences.
///
/// `descriptors`: a row per grain, a column per descriptor, in any units. `masses`: one per grain,
/// above 0. If K is the number of grains, all are chosen. The result for a seed does not depend on
/// the number of threads. Throws Error(InvalidInput) for more templates than grains, numbers that
/// are not finite, masses of 0, a descriptor with only one value and options out of range;
/// Cancelled.
SampleTemplates choose_templates(const Eigen::MatrixXd& descriptors,
                                 const std::vector<double>& masses, const TemplateOptions& options,
                                 const Execution& execution);

}  // namespace wscvt
