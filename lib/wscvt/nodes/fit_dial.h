// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// All that a fit of nodes turns with the wanted mean edge ratio, from even triangles to a close
/// surface. Found by measuring six grains at 1000 nodes.
struct FitDial {
  double ratio = 0.0;  ///< wanted mean ratio of longest to shortest edge
  int samples_a_node = 0;
  int rounds = 0;
  int late_rounds = 0;            ///< the last of them, which keep the least angle
  double least_angle = 0.0;       ///< degrees, kept by the late rounds
  double early_angle = 0.0;       ///< kept by those before
  double start_evenness = 0.0;    ///< evenness where the first rounds lead to
  double lead_rounds = 0.0;       ///< how many rounds lead there
  int heats = 1;                  ///< how often these begin anew
  double first_steering = 0.0;    ///< round from which the evenness is led by the ratio
  double ratio_slope = 0.0;       ///< by how much the ratio falls as the evenness grows e times
  double plain_springs = 1.0;     ///< share of the springs that pull edges to their rest lengths
  double triangle_springs = 0.0;  ///< of those that pull a triangle's edges to each other
  double damping = 0.0;           ///< of steps
  bool polishes = false;          ///< whether nodes are moved one by one after a round
};

/// `ratio` in [least_edge_ratio, most_edge_ratio], which is not checked.
FitDial fit_dial(double ratio);

}  // namespace wscvt
