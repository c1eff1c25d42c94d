// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// All settings of the fit that depend on the wanted mean edge ratio, from even triangles to a
/// close surface. Found by measuring six grains at 1000 nodes.
struct FitDial {
  double ratio = 0.0;  ///< wanted mean ratio of longest to shortest edge
  int samples_a_node = 0;
  int rounds = 0;
  int late_rounds = 0;            ///< the last rounds, which keep the least angle
  double least_angle = 0.0;       ///< degrees, kept by the late rounds
  double early_angle = 0.0;       ///< kept by the earlier rounds
  double start_evenness = 0.0;    ///< evenness that the first rounds lead to
  double lead_rounds = 0.0;       ///< number of rounds that lead there
  int heats = 1;                  ///< number of such leads, one after the other
  double first_steering = 0.0;    ///< round from which the ratio controls the evenness
  double ratio_slope = 0.0;       ///< fall of the ratio as the evenness grows by a factor e
  double plain_springs = 1.0;     ///< fraction of the springs that pull edges to their rest lengths
  double triangle_springs = 0.0;  ///< of springs between a triangle's edges
  double damping = 0.0;           ///< of steps
  bool polishes = false;          ///< whether single nodes are moved after a round
};

/// `ratio` in [least_edge_ratio, most_edge_ratio], which is not checked.
FitDial fit_dial(double ratio);

}  // namespace wscvt
