// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/surface/quadric_surface.h"
#include "wscvt/tessellation/weights.h"

/// Weightings on an ellipsoid, for the tests of what stands on them.
namespace wscvt::test {

/// No two axes alike, so that every weighting varies over it.
inline const Ellipsoid& ellipsoid() {
  static const Ellipsoid surface(Vector3(1.3, 0.9, 0.7));
  return surface;
}

inline SurfaceSeedModel model_of(const RadialSurface& surface, Weighting weighting,
                                 int nodes = 1000, double alpha = 1.0) {
  WeightingOptions options;
  options.kind = weighting;
  options.curvature_alpha = alpha;
  return {surface, options, nodes, Execution(1)};
}

}  // namespace wscvt::test
