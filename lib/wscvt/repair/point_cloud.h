// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/repair/scan_options.h"

namespace wscvt {

/// Returns a closed, star-shaped mesh with the given points as vertices, in any order: the Delaunay
/// triangulation of their directions from the centre of the enclosed body. It is used for scans of
/// points without faces (the paper's starting point). Merges equal points.
///
/// The surface has no overhangs, even if the body has: each direction from the centre has one
/// radius. Its volume and area may differ from the body's.
///
/// Throws as different_points (usable_scan.h); Error(NumericalFailure) if the points do not
/// surround their centre or two points lie on one ray; Error(Cancelled).
IndexedMesh mesh_of_points(std::vector<Vector3> points, const Execution& execution = Execution(1));

/// Returns the scan itself or, with `points_only`, mesh_of_points of its points. Throws
/// Error(InvalidInput), with the option to set, if the scan has no faces and `points_only` is
/// false, because a scan that has lost its faces must not pass for a cloud. Throws as
/// mesh_of_points.
IndexedMesh with_surface(IndexedMesh scan, bool points_only, const Execution& execution);

/// Writes the input's counts into the report on a surface made from points or a shrink-wrap:
/// points, different points, and unused faces.
void count_given(std::size_t points, std::size_t faces, std::size_t different,
                 MeshCheckReport& report);

}  // namespace wscvt
