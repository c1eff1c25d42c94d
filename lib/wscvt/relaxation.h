// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace wscvt {

struct RelaxationOptions {
  int maximum_iterations = 1000;         ///< >= 0
  double displacement_tolerance = 1e-3;  ///< rms displacement / h, h = sqrt(4 pi / N); > 0
  double area_tolerance = 0.07;          ///< spread of cell area / target; > 0
  double over_relaxation = 1.8;          ///< step factor towards the centroid, in (0, 2)
};

/// One line of the iteration's history.
struct RelaxationStep {
  double displacement = 0.0;  ///< rms distance seed to cell centroid / h
  double area_spread = 0.0;   ///< standard deviation of (cell area / its target)
  int flips = 0;              ///< edges flipped to restore the regular triangulation
};

struct RelaxationReport {
  bool converged = false;
  int iterations = 0;
  int rebuilds = 0;  ///< triangulations built from scratch because a flip stuck, after the first
  std::vector<RelaxationStep> history;
};

}  // namespace wscvt
