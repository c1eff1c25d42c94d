// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Drops the faces with a corner that is not finite. Returns their number. Later code need not
/// check indices and corners: CGAL's trees of boxes do not terminate if a coordinate is NaN. Throws
/// Error(InvalidInput) if the mesh has no vertices or no faces, more than can be numbered, an index
/// out of range, or no usable face.
std::size_t keep_usable_faces(IndexedMesh& mesh, const Execution& execution);

/// Returns the points in ascending order, each once. Throws Error(InvalidInput) for fewer than 4
/// different points, coordinates that are not finite, or an extent not between 1e-60 and 1e60;
/// Error(Cancelled).
std::vector<Vector3> different_points(std::vector<Vector3> points, const Execution& execution);

}  // namespace wscvt
