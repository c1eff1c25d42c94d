// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// Radii for which the flat triangles over `directions` are, all together, nearest to `surface`.
///
/// On a flat triangle 1/r is linear in the barycentric coordinates of the direction, so the radii
/// come from two sparse symmetric solves. Their squares, of the difference in 1/r, are weighted
/// with dOmega g r^4 cos^2(tilt), which makes them squares of the distance square to the surface,
/// integrated over the surface; the second time also with (r_fit / r)^2 of the first fit, without
/// which the spikes that few nodes may throw up hardly count. `samples` points are wanted in all.
/// Every triangle gets the same square number of them, rounded up, but at least 9 and at most 1024.
///
/// Every radius stays within a factor 1.5 of the surface's own in that direction. Throws
/// Error(InvalidInput) if a direction belongs to no triangle, Error(NumericalFailure) when the
/// system cannot be solved.
std::vector<double> least_squares_radii(const std::vector<Vector3>& directions,
                                        const std::vector<Triangle>& triangles,
                                        const RadialSurface& surface, std::size_t samples,
                                        const Execution& execution);

/// Scales the points uniformly about the origin so that the closed outward mesh encloses `volume`
/// (> 0, length^3) to rounding. Throws Error(NumericalFailure) when `volume` or the volume that the
/// mesh encloses before is not positive; the points are then as they were.
void scale_to_volume(const std::vector<Triangle>& triangles, double volume,
                     std::vector<Vector3>& points, const Execution& execution);

}  // namespace wscvt
