// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Computes the diameters of a closed mesh, in its unit of length, with its convex hull.
///
/// The largest Feret diameter is exact up to 4,000 points of the hull. For more points, two extreme
/// points of 2,000 directions are found and moved to the farthest of all points. The smallest is a
/// width across a face of the hull or between two of its edges (Houle and Toussaint 1988,
/// "Computing the width of a set", IEEE Trans. Pattern Anal. Mach. Intell. 10, 761-765). It is the
/// best of all faces, and of directions followed downhill from the best faces and by
/// smallest_over_directions. W and T are chords between points of the body's surface, as Taylor,
/// Garboczi et al. (2006, "Some properties of irregular 3-D particles", Powder Technol. 162, 1-15)
/// define them, not widths of its shadow. W is the longest chord in a plane perpendicular to L (128
/// planes; the best is then moved). T is the longest chord perpendicular to both (on lines of a 128
/// by 128 lattice). For the series of three NIST particles, chords agree within 5 % with their
/// published W and T, widths of the shadow within 23 %.
///
/// Throws Error(InvalidInput) for fewer than four points, Error(Cancelled).
FeretDiameters feret_diameters(const IndexedMesh& mesh, const IndexedMesh& hull,
                               const Execution& execution);

/// Returns the integral of the mean curvature (k1 + k2) / 2 over a closed mesh: half the sum over
/// its edges of length times the angle between the normals, positive at ridges (Steiner's formula).
/// For a convex body it is 2 pi times the mean Feret diameter. Length.
double mean_curvature_integral(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
