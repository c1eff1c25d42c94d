// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Measures roughness above a surface that is the mesh itself without its short waves, in two
/// passes of SurfaceLowPass: B = p(h) X filters the vertices X in the metric of X itself, heights
/// are z = (X - B) . n along the normals n of B, and the second pass filters X in the metric of
/// X - z n, which the roughness no longer lengthens (one pass loses 4 % of steep waves). Works on
/// any closed body, also on one that no ray sees whole. Where Sq is below 1e-12 of `cutoff` there
/// is no roughness to speak of, and Ssk and Sku are 0.
///
/// `cutoff` > 0, length: waves longer than that are form. Throws Error(InvalidInput) for a cut-off
/// that is not positive, or less than least_cutoff(mesh): such edges do not carry the
/// waves.
Roughness surface_roughness(const IndexedMesh& mesh, double cutoff, const Execution& execution);

/// The least cut-off length that surface_roughness takes for a mesh: three times the mean length of
/// its edges, each face's by its area.
double least_cutoff(const IndexedMesh& mesh);

}  // namespace wscvt
