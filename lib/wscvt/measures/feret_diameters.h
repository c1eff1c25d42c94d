// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Diameters of a closed mesh, whose convex hull has the points `hull`.
///
/// The largest Feret diameter is exact up to 4,000 points of the hull; beyond, two points are found
/// among the extreme ones of 2,000 directions and moved to the farthest of all. The smallest is a
/// minimum over directions (smallest_over_directions), near 0.1 %. W and T are chords of the body
/// between points of its surface, as Taylor, Garboczi et al. (2006, "Some properties of irregular
/// 3-D particles", Powder Technol. 162, 1-15) define them, not widths of its shadow: W the longest
/// one in a plane across L (128 planes, the best then moved), T the longest one across both (on
/// lines of a 128 by 128 lattice). Chords between points of the series of three NIST particles
/// agree within 5 % with the W and T that come with them, widths of the shadow within 23 %.
///
/// Throws Error(InvalidInput) for fewer than four points, Error(Cancelled).
FeretDiameters feret_diameters(const IndexedMesh& mesh, const std::vector<Vector3>& hull,
                               const Execution& execution);

/// Integral of the mean curvature (k1 + k2) / 2 over a closed mesh: half the sum over its edges of
/// length times the angle between the normals, positive at ridges (Steiner's formula). 2 pi times
/// the mean Feret diameter where the body is convex. Length.
double mean_curvature_integral(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
