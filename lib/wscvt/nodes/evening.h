// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/edit_mesh.h"

namespace wscvt {

/// The surface that nodes are evened on: a mesh of some twenty vertices a node.
struct EveningSurface {
  EditMesh mesh;
  std::vector<double> density;  ///< of nodes wanted at each vertex, mean 1; empty: the same
};

/// What evening did.
struct EveningReport {
  int steps = 0;
  int flips = 0;
};

/// Makes nodes even in space: they move to the centroids of their Voronoi cells on the surface,
/// again and again (Lloyd's method for a centroidal Voronoi tessellation: Du, Faber, Gunzburger
/// 1999, SIAM Rev. 41, 637), with momentum, and edges are flipped to Delaunay. The cells come from
/// the nodes' own triangles. Nodes at a sharp rim are pushed outwards before they are put back on
/// the surface: the nearest point from outside is the rim. A node is put back by a walk over the
/// surface from where it was, so that it never changes the sheet of a thin body.
///
/// `nodes`: a closed mesh near the surface, moved in place; `places`: a triangle of the surface
/// near each node, kept up to date. Cancels by Error(Cancelled). The same on any number of threads.
EveningReport even_nodes(EditMesh& nodes, std::vector<std::int32_t>& places,
                         const EveningSurface& surface, int steps, const Execution& execution);

/// Area of the Voronoi cell of every node, from the nodes' own triangles; where a triangle is very
/// obtuse its circumcentre is drawn in, so that the areas still add up to the mesh's.
std::vector<double> voronoi_areas(const EditMesh& nodes);

}  // namespace wscvt
