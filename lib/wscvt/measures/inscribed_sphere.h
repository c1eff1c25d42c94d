// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A sphere inside a body, and how much larger the largest one can be at most.
struct InscribedSphere {
  Vector3 centre = Vector3::Zero();  ///< length
  double radius = 0.0;               ///< length; the sphere lies inside
  double upper_bound = 0.0;          ///< length; no sphere inside is larger than this
};

/// The largest sphere inside a closed mesh, whose radius Wadell's roundness refers to (see
/// roundness.h), by a search of this library: branch and bound on cubes for the point farthest from
/// the surface (exact point-to-triangle distances, which change no faster than the point moves).
/// Stops when upper_bound <= 1.001 radius, or after 50,000 distances (a body with a broad plateau,
/// such as a plate between parallel faces, ends there). Throws Error(InvalidInput) if the mesh has
/// no faces or nothing inside.
InscribedSphere largest_inscribed_sphere(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
