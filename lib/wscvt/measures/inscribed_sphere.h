// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// The largest sphere inside a closed mesh, whose radius Wadell's roundness refers to (see
/// roundness.h), by a search of this library: branch and bound on cubes for the point farthest from
/// the surface (exact point-to-triangle distances, which change no faster than the point moves;
/// points that a sphere touches bound them all about its centre). Stops when upper_bound <= 1.001
/// radius, or after 50,000 distances (a body with a broad plateau, such as a plate between parallel
/// faces, ends there). Throws Error(InvalidInput) if the mesh has no faces or nothing inside.
InscribedSphere largest_inscribed_sphere(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
