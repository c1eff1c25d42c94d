// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Drops the faces with a corner at no finite position; returns how many. Everything after it may
/// take indices and corners as they are: CGAL's trees of boxes do not end on coordinates that are
/// not numbers. Throws Error(InvalidInput) for a mesh without vertices, without faces, with more
/// than can be numbered, with an index out of range, or of which nothing would be left.
std::size_t keep_usable_faces(IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
