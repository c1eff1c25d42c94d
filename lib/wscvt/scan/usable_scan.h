// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Drops the faces with a corner at no finite position; returns how many. Everything after it may
/// take indices and corners as they are: CGAL's trees of boxes do not end on coordinates that are
/// not numbers. Throws Error(InvalidInput) for a mesh without vertices, without faces, with more
/// than can be numbered, with an index out of range, or of which nothing would be left.
std::size_t keep_usable_faces(IndexedMesh& mesh, const Execution& execution);

/// The points in ascending order, each once. Throws Error(InvalidInput) for fewer than 4 different
/// points, coordinates that are not finite or an extent not between 1e-60 and 1e60;
/// Error(Cancelled).
std::vector<Vector3> different_points(std::vector<Vector3> points, const Execution& execution);

}  // namespace wscvt
