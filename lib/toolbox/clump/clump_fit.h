// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "toolbox/clump/clump_options.h"
#include "toolbox/clump/sphere.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// A number of spheres during the fit, and its error.
struct ClumpStage {
  std::size_t spheres = 0;
  double rms_distance = 0.0;  ///< from scan to spheres; length
};

/// Spheres fitted to a body, and the error for each number of spheres.
struct FittedSpheres {
  std::vector<Sphere> spheres;
  std::vector<ClumpStage> stages;  ///< ascending; each refined in fewer steps than the last one
};

/// Fits spheres to a closed outward mesh of equivalent radius 1 about its centroid, in its
/// principal axes. Bodies in other poses then get the same spheres.
///
/// Spheres are added one by one, and all are refined after each (see SphereFit). Each added sphere
/// touches the surface from within and lowers the energy most. At first a sphere that bulges out
/// costs eight times what a gap costs. Then the least important spheres are moved to better places
/// as long as that helps, and the weight of eight is reduced to one. In the end all radii change by
/// one length, so that the union has the grain's volume. They do not if the volume is off by more
/// than 10 %. With `options.inside` spheres stay inside instead. The result has fewer spheres than
/// asked for only if no more of the smallest radius fit inside.
///
/// With an allowed error, `error_percent` returns the error of spheres; empty: the rms distance. If
/// the refined spheres do not meet it, more are added.
///
/// The result does not depend on the number of threads. Throws Error(InvalidInput) if nothing is
/// inside or no sphere of the smallest radius fits in; Error(Cancelled).
FittedSpheres fit_spheres(
    const IndexedMesh& unit_grain, const ClumpOptions& options, const Execution& execution,
    const std::function<double(const std::vector<Sphere>&)>& error_percent = {});

/// Root mean square and largest absolute distance of points to the union of spheres: the minimum of
/// |p - c| - r over the spheres, which is exact outside the union.
struct UnionDistance {
  double root_mean_square = 0.0;
  double largest = 0.0;
};
UnionDistance union_distance(const std::vector<Vector3>& points, const std::vector<Sphere>& spheres,
                             const Execution& execution);

}  // namespace wscvt
