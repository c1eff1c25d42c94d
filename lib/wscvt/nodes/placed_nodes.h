// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/surface/grain.h"
#include "wscvt/tessellation/relaxation.h"

namespace wscvt {

/// Whether place_nodes will read Grain::rays.
bool needs_rays(const PlacementOptions& options, bool is_scan);

/// The nodes and their mesh, in the grain's units and about the origin.
struct PlacedNodes {
  IndexedMesh mesh;
  std::vector<Vector3> directions;  ///< unit, from the origin to each node
  std::vector<double> radii;        ///< |node|
  /// Surface area of each node's power cell, or, after refinement, a third of its triangles'.
  std::vector<double> cell_areas;
  RefinementReport refinement;
  TriangleMendingReport mending;  ///< of fitted nodes with small angles, see mend_radial_nodes
  NormalFitReport fit;            ///< of those
};

/// Puts relaxed seeds where `options` want them. `metric` is the one they were relaxed in, which
/// says what their cells' areas are; `volume` (> 0) is what the mesh encloses after a least-squares
/// placement. The triangulation becomes the intrinsic Delaunay one of the nodes on their surface.
/// Seeds relaxed in the surface metric and fitted without refinement are mended, where triangles of
/// a scan's are left with small angles (mend_radial_nodes).
/// Throws Error: InvalidInput for options out of range or rays that are needed and missing,
/// NumericalFailure, Cancelled.
PlacedNodes place_nodes(const Grain& grain, RelaxationResult relaxed, RelaxationMetric metric,
                        double volume, const PlacementOptions& options, const Execution& execution);

/// Largest absolute principal curvature of the grain's surface in each direction, 1 / length.
std::vector<double> largest_curvatures(const SphereSurface& surface,
                                       const std::vector<Vector3>& directions,
                                       const Execution& execution);

/// The same at the vertices of a closed mesh by quadrics over two rings, where there is no surface
/// over the sphere to ask.
std::vector<double> largest_curvatures(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
