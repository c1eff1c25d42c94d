// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Measures roughness above the mesh without its short waves, in two passes of SurfaceLowPass. B =
/// p(h) X filters the vertices X in the metric of X. The heights are z = (X - B) . n along the
/// normals n of B. The second pass filters X in the metric of X - z n, which the roughness no
/// longer lengthens; with one pass, 4 % of steep waves are lost. Works on any closed body, also
/// with overhangs. If Sq is below 1e-12 of `cutoff`, the surface counts as smooth, and Ssk and Sku
/// are 0.
///
/// `cutoff` > 0, length: longer waves are form. Throws Error(InvalidInput) if the cut-off is not
/// positive or below least_cutoff(mesh), because the edges are then too long for such waves.
Roughness surface_roughness(const IndexedMesh& mesh, double cutoff, const Execution& execution);

/// Returns the least cut-off length that surface_roughness accepts for a mesh: three times the
/// area-weighted mean length of the faces' edges.
double least_cutoff(const IndexedMesh& mesh);

}  // namespace wscvt
