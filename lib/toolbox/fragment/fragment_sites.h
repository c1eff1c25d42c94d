// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "toolbox/fragment/cell_complex.h"
#include "toolbox/fragment/fragment_options.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Returns about `count` points evenly in a closed mesh: on lines along z, whose distance is the
/// points' own. Deterministic.
std::vector<Vector3> points_in(const IndexedMesh& mesh, double volume, std::size_t count);

/// Places the sites of the fragments' cells by Lloyd's steps on points_in: each site moves to the
/// centroid of its cell (Du, Faber and Gunzburger 1999, "Centroidal Voronoi tessellations", SIAM
/// Rev. 41, 637-676). Works in the grain's principal frame, so the sites turn with the grain. With
/// `volumes` the cells are power cells, whose weights grow where the volume is too small; with
/// `near` the points count as (d + r / 5)^-5, d their distance from the nearest of `near` and r
/// the equivalent radius, which makes the size of a cell proportional to d + r / 5 (Gersho's
/// conjecture). `shape` is of the mesh, which is closed and outward. The result does not depend on
/// the number of threads. Throws Error(NumericalFailure) for a mesh too thin for the points.
std::vector<CellSite> fragment_sites(const IndexedMesh& mesh, const ShapeDescriptors& shape,
                                     const FragmentOptions& options, const Execution& execution);

}  // namespace wscvt
