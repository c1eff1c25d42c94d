// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/clump/clump_options.h"
#include "wscvt/clump/sphere.h"

namespace wscvt {

/// A number of spheres on the way to the last one, and how near they come.
struct ClumpStage {
  std::size_t spheres = 0;
  double rms_distance = 0.0;  ///< from scan to spheres; length
};

/// Spheres fitted to a body, and how the error fell with their number.
struct FittedSpheres {
  std::vector<Sphere> spheres;
  std::vector<ClumpStage> stages;  ///< ascending; each refined as the last one, but in fewer steps
};

/// Fits spheres to a closed outward mesh of equivalent radius 1 about its centroid, in its
/// principal axes: bodies in other poses then get the same spheres.
///
/// Spheres are added one by one, each the sphere touching the surface from within (see
/// medial_spheres) that lowers the energy most, and all are refined after each (see SphereFit). At
/// first a sphere that bulges out costs eight times what a gap costs. Then spheres that matter
/// least are moved to where they matter more, as long as that helps; and the weight of eight is let
/// down to one. With `options.inside` spheres stay inside. Fewer spheres than asked for come only
/// where no more of the smallest radius fit inside.
///
/// The same bits on any number of threads. Throws Error(InvalidInput) where nothing is inside, or
/// no sphere of the smallest radius fits in; Error(Cancelled).
FittedSpheres fit_spheres(const IndexedMesh& unit_grain, const ClumpOptions& options,
                          const Execution& execution);

/// Root mean square and largest absolute distance of points to the union of spheres: the least over
/// the spheres of |p - c| - r, which is exact outside of the union.
struct UnionDistance {
  double root_mean_square = 0.0;
  double largest = 0.0;
};
UnionDistance union_distance(const std::vector<Vector3>& points, const std::vector<Sphere>& spheres,
                             const Execution& execution);

}  // namespace wscvt
