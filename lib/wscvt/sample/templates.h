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

/// Real grains that stand for a sample.
struct SampleTemplates {
  std::vector<std::size_t> grains;  ///< their rows, ascending; K of them
  /// Weights of the K grains; they sum to 1. By number the grains have the sample's distributions
  /// of the descriptors, by mass those in which each grain of the sample counts by its mass.
  std::vector<double> by_number;
  std::vector<double> by_mass;
  /// For each grain of the sample the template that is nearest in the space of the descriptors, as
  /// a number below K.
  std::vector<std::size_t> stands_for;
  TemplateDistances reached;
  TemplateDistances random;  ///< of K random grains of equal weights: the mean of 20 choices
};

/// Chooses K grains of a sample and weights for them, so that their distributions of the
/// descriptors are close to those of the sample: by exchanging one grain at a time, with weights by
/// non-negative least squares on the distribution functions, which at last are turned into least
/// absolute differences.
///
/// `descriptors`: a row per grain, a column per descriptor, in any units. `masses`: one per grain,
/// above 0. K = number of grains gives all of them. The same for a seed on any number of threads.
/// Throws Error(InvalidInput) for more templates than grains, numbers that are not finite, masses
/// of 0, a descriptor with one value only and options out of range; Cancelled.
SampleTemplates choose_templates(const Eigen::MatrixXd& descriptors,
                                 const std::vector<double>& masses, const TemplateOptions& options,
                                 const Execution& execution);

}  // namespace wscvt
