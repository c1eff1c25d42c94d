// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/tessellation/tessellation_options.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

struct RelaxationResult {
  std::vector<Vector3> seeds;         ///< unit vectors, in the order given
  SphereTriangulation triangulation;  ///< the regular one of the seeds and their weights
  std::vector<double> cell_areas;     ///< see PowerCells::areas
  RelaxationReport report;
};

/// Moves the seeds towards the centroids of their cells until one of these holds: both the rms
/// displacement and the standard deviation of (cell area / target) are below their tolerances, the
/// seeds are at rest, a further step would tear the triangulation, or the iterations are used up.
/// The report says which.
///
/// Each step is 1.2 times the way from seed to centroid, plus Nesterov's momentum, dropped whenever
/// it points uphill (O'Donoghue and Candes 2015, "Adaptive restart for accelerated gradient
/// schemes"). The target cell area is 3.118 w + C.
///
/// Throws Error(InvalidInput) for fewer than 4 seeds, Error(NumericalFailure) if the seeds cannot
/// be triangulated, Error(Cancelled).
///
/// `triangulation` of the seeds saves building one.
RelaxationResult relax(std::vector<Vector3> seeds, const SeedModel& model,
                       const RelaxationOptions& options, const Execution& execution,
                       std::optional<SphereTriangulation> triangulation = std::nullopt);

/// Detects seeds that no longer approach rest, as under steep weightings on rough scans, whose
/// flips never end: displacements of 0.05 h from the 70th iteration to the 1000th, at a constant
/// spread of the cells' areas.
class StallWatch {
 public:
  /// Returns whether none of the last three groups of fifty steps had a mean displacement well
  /// below the best before. The slowest relaxations that come to rest gain a tenth in fifty steps.
  /// Some with a few hundred seeds pause for a hundred steps and continue.
  bool stalled_at(double displacement) {
    sum_ += displacement;
    if (++steps_ < window) return false;
    if (sum_ < 0.95 * smallest_sum_) {
      smallest_sum_ = sum_;
      idle_ = 0;
    } else {
      ++idle_;
    }
    sum_ = 0.0;
    steps_ = 0;
    return idle_ >= 3;
  }

 private:
  static constexpr int window = 50;
  double sum_ = 0.0;
  double smallest_sum_ = std::numeric_limits<double>::infinity();
  int steps_ = 0;
  int idle_ = 0;  ///< groups of fifty without a gain
};

/// Nesterov's momentum, dropped whenever it points uphill (O'Donoghue and Candes 2015, "Adaptive
/// restart for accelerated gradient schemes").
class Momentum {
 public:
  /// Returns the fraction of the last change that the next step repeats.
  double carry(bool uphill) {
    if (uphill) weight_ = 1.0;
    const double grown = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * weight_ * weight_));
    const double share = (weight_ - 1.0) / grown;
    weight_ = grown;
    return share;
  }

 private:
  double weight_ = 1.0;
};

}  // namespace wscvt
