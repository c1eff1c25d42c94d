// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

/// Where cells lie.
enum class CellGeometry {
  UnitSphere,  ///< sites are unit vectors, cell vertices are normalised to the sphere
  Surface,     ///< sites lie on any smooth surface, cells in the planes of its triangles
};

/// The cells dual to a triangulation: one vertex a triangle, one cell a site.
struct PowerCells {
  std::vector<Vector3> vertices;   ///< per triangle: the radical centre of its sites
  std::vector<Vector3> centroids;  ///< per site: of its cell, moved to the site's tangent plane
  std::vector<double> areas;       ///< per site: signed area (solid angle on the unit sphere)
};

/// Computes the cells of `sites` under `triangulation` (the paper, eqs. 6 to 9).
///
/// The three perpendiculars through the weighted midpoints of a triangle's edges meet in one point,
/// its radical centre (eqs. 6 to 8). A cell is the fan of triangles (site, centre, next centre);
/// areas are signed along the site's normal, so centres outside their triangle count rightly (eq.
/// 9, which as printed takes absolute areas). The normal is the site itself on the sphere, and the
/// area-weighted mean of the triangles' normals on a surface.
///
/// `weights` (length^2 of the sites' space; empty: none) and `densities` (> 0, linear within the
/// fan; empty: constant) hold one value a site. `cells` is overwritten; its capacity is reused.
///
/// Throws Error(InvalidInput) when there is not one site a vertex of the triangulation, or weights
/// or densities are given but not one a site. Their values are not checked.
void compute_power_cells(const SphereTriangulation& triangulation,
                         const std::vector<Vector3>& sites, const std::vector<double>& weights,
                         const std::vector<double>& densities, CellGeometry geometry,
                         const Execution& execution, PowerCells& cells);

}  // namespace wscvt
