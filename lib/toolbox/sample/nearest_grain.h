// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "toolbox/sample/sample_grain.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// A real grain near a virtual one.
struct NearestGrain {
  std::size_t grain = 0;  ///< its number in the sample
  /// Root mean square over the directions of the difference of the two radii in their principal
  /// frames, both scaled to radius 1, for the best of the eight mirror images; no unit.
  double distance = 0.0;
};

/// Finds the nearest grain of a sample, over all grains and mirror images.
class GrainSearch {
 public:
  /// Copies the series. Throws Error(InvalidInput) for an empty sample.
  explicit GrainSearch(const std::vector<SampleGrain>& sample);

  /// `left_out`: a grain of the sample to ignore; the sample's size to ignore none. May be called
  /// from several threads. Throws Error(InvalidInput) for a series of another length.
  NearestGrain nearest(const std::vector<double>& radial, std::size_t left_out) const;
  NearestGrain nearest(const std::vector<double>& radial) const {
    return nearest(radial, static_cast<std::size_t>(sorted_.cols()));
  }

  /// Returns the usual distance within the sample: the median over at most 400 grains of the
  /// distance to their nearest other grain. 0 for a sample of one grain.
  double usual_distance(const Execution& execution) const;

 private:
  Eigen::VectorXd in_classes(const std::vector<double>& radial) const;

  std::vector<Eigen::Index> places_;       ///< of the coefficients, class by class
  std::array<Eigen::Index, 9> classes_{};  ///< where the mirror classes begin among them
  Eigen::MatrixXd sorted_;                 ///< a column per grain
  Eigen::VectorXd squares_;
  Eigen::MatrixXd amplitudes_;  ///< of the degrees, a column per grain
};

}  // namespace wscvt
