// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/fit_dial.h"

#include <algorithm>
#include <cmath>

#include "wscvt/nodes/scan_nodes_options.h"

namespace wscvt {

FitDial fit_dial(double ratio) {
  // x: distance from the evenest ratio that costs no distance; close: position in the close range,
  // in which a fit is led several times.
  const double x = std::max(0.0, ratio - default_edge_ratio);
  const double close = std::clamp((x - 0.2) / 0.2, 0.0, 1.0);
  FitDial dial;
  dial.ratio = ratio;
  dial.samples_a_node = static_cast<int>(30.0 + 40.0 * x);
  dial.rounds = static_cast<int>(16.0 + 12.0 * std::min(1.0, x / 0.06) + 20.0 * close);
  dial.late_rounds = std::min(6, dial.rounds / 2 - 1);
  dial.least_angle = std::max(30.0, 35.0 - 80.0 * x);
  dial.early_angle = std::min(20.0, std::max(5.0, 0.5 * dial.least_angle));
  const bool even = x < 0.02;
  dial.start_evenness = std::clamp(
      std::exp(-15.7 * (ratio - default_edge_ratio) - 25.0 * std::max(0.0, ratio - 1.505)), 1e-6,
      1.0);
  dial.lead_rounds = even ? dial.rounds - 3 : std::max(1.0, (0.4 + 0.3 * close) * dial.rounds);
  dial.heats = close > 0.3 ? 3 : 1;
  dial.first_steering = even ? dial.rounds / 3 : dial.lead_rounds;
  dial.ratio_slope = 0.03 + 0.25 * x;
  dial.plain_springs = std::max(0.1, 1.0 - 11.0 * x);
  dial.triangle_springs = 0.3 * (1.0 - dial.plain_springs) / 0.9;
  dial.damping = std::pow(10.0, -3.0 - 2.0 * std::min(0.5, x));
  dial.polishes = x > 0.06;
  return dial;
}

}  // namespace wscvt
