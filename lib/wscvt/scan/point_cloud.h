// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/scan_options.h"

namespace wscvt {

/// Closed, star-shaped mesh with the given points as vertices, in any order: the Delaunay
/// triangulation of their directions from the centre of what they enclose. This is how a scan given
/// as points without faces enters (the paper's starting point). Equal points are merged.
///
/// The surface has no folds, whatever the body has: each direction from the centre has one radius.
/// Its volume and area are its own, not the body's.
///
/// Throws as different_points (usable_scan.h); Error(NumericalFailure) when the points do not
/// surround their centre or two lie on one ray; Error(Cancelled).
IndexedMesh mesh_of_points(std::vector<Vector3> points, const Execution& execution = Execution(1));

/// The scan itself, or, with `points_only`, mesh_of_points of its points. Throws
/// Error(InvalidInput), which says how to choose points, for points without faces that were not
/// chosen: a scan that has lost its faces must not pass for a cloud. Throws as mesh_of_points does.
IndexedMesh with_surface(IndexedMesh scan, bool points_only, const Execution& execution);

/// Puts into the report on a surface made of points, or of an envelope, what was given: so many
/// points, of which so many were different, and faces that were not used.
void count_given(std::size_t points, std::size_t faces, std::size_t different,
                 MeshCheckReport& report);

}  // namespace wscvt
