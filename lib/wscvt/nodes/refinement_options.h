// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/option.h"

namespace wscvt {

/// How nodes are brought nearer to the scan, after Hoppe et al. 1993, "Mesh optimization": moves,
/// flips and relocations (see node_refinement.h).
struct RefinementOptions {
  int rounds = 0;  ///< at most so many, up to 1000; 0: nothing is done
  /// No triangle is left a smaller one, but for a few that guards hold (see node_refinement.h);
  /// degrees, 0 to 40. Rms of meshes/sand_7228.ply with 1000 error-adaptive nodes at 15.5, 25, 30,
  /// 35, 40: .164, .171, .177, .188, .210 % of R, at mean edge ratios of 1.86, 1.69, 1.60, 1.49,
  /// 1.40; the collapse of Lindstrom and Turk has .192, and angles down to 0.
  double smallest_angle = 30.0;
  double tolerance = 2e-3;  ///< stop when a round gains less than this share, in [0, 1)
};

inline constexpr NumberOption<int> refinement_rounds_option = {
    "refine",   "number of refinement rounds",
    0,          1000,
    Ends::Both, "moving nodes and flipping edges towards the scan, for least squares and contact"};
inline constexpr NumberOption<double> refinement_angle_option = {
    "refine-angle", "smallest angle that the refinement leaves, in degrees", 0.0, 40.0};
inline constexpr NumberOption<double> refinement_tolerance_option = {
    "refine-tolerance", "share below which the gain of a refinement round is the last", 0.0, 1.0,
    Ends::NotMaximum};

/// One line of the refinement's history.
struct RefinementStep {
  /// The distance after the round, see refine_nodes; length.
  double distance = 0.0;
  int moves = 0;        ///< nodes moved
  int flips = 0;        ///< edges flipped
  int relocations = 0;  ///< nodes taken from where they help least to where they help most
};

/// How a refinement went.
struct RefinementReport {
  /// The last round's moves, flips and relocations lowered the square root of the sum that is
  /// lowered by less than the tolerance, as a share of it.
  bool converged = false;
  double start_distance = 0.0;  ///< as RefinementStep::distance, before the first round; length
  std::vector<RefinementStep> history;
};

/// Throws Error(InvalidInput) for options out of range.
void check_refinement_options(const RefinementOptions& options);

}  // namespace wscvt
