// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {

/// The surface for edge-length equalization: a mesh of some twenty vertices per node.
struct EqualizationSurface {
  EditMesh mesh;
  std::vector<double> density;  ///< wanted at each vertex, mean 1; empty: uniform
};

/// Settings of even_nodes.
struct EqualizationSteps {
  int count = 100;
  /// Nodes move so many times as far as to the centroids of their cells, 1 to 2 (Lloyd's method
  /// over-relaxed: Xiao 2010, master's thesis, University of South Carolina). With 2, fewer nodes
  /// than with 1 end with another number of neighbours than six.
  double over_relaxation = 1.0;
};

/// Counts of even_nodes.
struct EqualizationReport {
  int steps = 0;
  int flips = 0;
};

/// Equalizes the spacing of nodes. They move to the centroids of their Voronoi cells on the surface
/// repeatedly (Lloyd's method for a centroidal Voronoi tessellation: Du, Faber, Gunzburger 1999,
/// SIAM Rev. 41, 637), with momentum, and edges are flipped to Delaunay. The cells are computed
/// from the nodes' own triangles. Nodes at a sharp rim are pushed outwards before they are
/// projected to the surface, because the nearest point from outside is the rim. A node is projected
/// by a walk over the surface from its old place, so that it never changes the sheet of a thin
/// body.
///
/// `nodes`: a closed mesh near the surface, moved in place; `places`: a triangle of the surface
/// near each node, updated. Throws Error(Cancelled). The result does not depend on the number of
/// threads.
EqualizationReport even_nodes(EditMesh& nodes, std::vector<std::int32_t>& places,
                              const EqualizationSurface& surface, const EqualizationSteps& steps,
                              const Execution& execution);

/// Returns the area of every node's Voronoi cell, from the nodes' own triangles. The circumcentre
/// of a very obtuse triangle is moved inwards, so that the areas still sum to the mesh's area.
std::vector<double> voronoi_areas(const EditMesh& nodes);

}  // namespace wscvt
