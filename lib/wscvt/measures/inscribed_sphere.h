// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Finds the largest sphere inside a closed mesh; Wadell's roundness refers to its radius (see
/// roundness.h). A branch-and-bound search on cubes finds the point farthest from the surface. It
/// uses exact point-to-triangle distances, which change no faster than the point moves. Points that
/// a sphere touches bound all distances about its centre. Stops if upper_bound <= 1.001 radius, or
/// after 50,000 distances (for bodies with a broad plateau, such as a plate with parallel faces).
/// Throws Error(InvalidInput) if the mesh has no faces or nothing inside.
InscribedSphere largest_inscribed_sphere(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
