// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

/// The cells dual to a triangulation: one vertex per triangle, one cell per site.
struct PowerCells {
  std::vector<Vector3> vertices;   ///< per triangle: the radical centre of its sites
  std::vector<Vector3> centroids;  ///< per site: of its cell, moved to the site's tangent plane
  /// Per site: signed, of the flat fan, seen along the site; the solid angle less about 2 /
  /// (number of sites) of it; steradian.
  std::vector<double> areas;
};

/// Computes the cells of `sites`, unit vectors, under `triangulation` (the paper, eqs. 6 to 9).
///
/// The three perpendiculars through the weighted midpoints of a triangle's edges meet in one point,
/// its radical centre (eqs. 6 to 8), which is normalised to the sphere. A cell is the fan of
/// triangles (site, centre, next centre). Areas are signed along the site, so centres outside their
/// triangle count correctly (eq. 9 as printed uses absolute areas).
///
/// `weights` (steradian; empty: none) has one value per site. `cells` is overwritten; its capacity
/// is reused.
///
/// Throws Error(InvalidInput) if the sites, or the weights if given, are not one per vertex of the
/// triangulation. Their values are not checked.
void compute_power_cells(const SphereTriangulation& triangulation,
                         const std::vector<Vector3>& sites, const std::vector<double>& weights,
                         const Execution& execution, PowerCells& cells);

}  // namespace wscvt
