// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// Two steps of grey values across the surface of grains, such as of a coat, a film or a core.
struct EdgeSteps {
  double space = 0.0;      ///< grey value of the void
  double layer = 0.0;      ///< of a layer at the surface
  double inside = 0.0;     ///< of what is below it
  double thickness = 0.0;  ///< of the layer; voxels; 0: too thin to measure, see film_between
  double fraction = 0.0;   ///< of the surface of all grains, 0 to 1

  /// The grey values go on from the void beyond the layer; otherwise they turn back.
  bool goes_on() const { return (layer > space) == (inside > layer); }
};

}  // namespace wscvt
