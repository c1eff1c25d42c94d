// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/nodes/refinement_target.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

struct RefinedNodes {
  std::vector<RefinementNode> nodes;
  SphereTriangulation triangulation;  ///< of their directions
  RefinementReport report;
};

/// Brings a mesh nearer to the original at the same number of nodes.
///
/// What is lowered is the sum of squared distances from points spread evenly over the original to
/// the plane of the triangle in their direction, after Hoppe et al. 1993, "Mesh optimization", with
/// distances far above the rms counted more (d^2 + d^4 / (3 rms)^2, rms that of the round's start),
/// and the nodes' own distances to the original's tangent plane added. A round
///  - moves every node, in all three dimensions, by a Gauss-Newton step in the triangles about it,
///    so that nodes slide on to ridges by themselves;
///  - flips edges, the most rewarding first;
///  - takes nodes from where they help least (their triangles joined to a neighbour) to where they
///    help most (an edge split), as long as that pays.
/// Nothing is done that does not lower the sum, turns a triangle over on the sphere of directions,
/// makes the smallest angle of the triangles concerned smaller than the limit, or than before where
/// it is below the limit already, or makes an edge turn further than the original does there (see
/// RefinementState::may_turn). So the mesh stays closed, and over a radial map star-shaped about
/// the origin; over any other its triangles may come to meet where sheets lie close to each other.
/// Where the mesh has smaller angles than the limit, a round begins with flipping edges and moving
/// nodes so that the angles grow, whatever that does to the sum.
///
/// The limit of the angles holds at the end. From six rounds on, the first three quarters of them,
/// and at most 35, allow angles of half the limit: those below it add to the sum, more from round
/// to round, until there are none (the quadratic penalty method: Nocedal and Wright 2006,
/// "Numerical Optimization", section 17.1). Steps that keep to the limit throughout get stuck early
/// (see AngleSchedule in the source). A few triangles that the other guards hold may stay below.
///
/// This is a descent. It does not alternate with the relaxation: nothing in it strives for
/// centroidal cells or even triangles, and the angle limit is all that guards the shape.
///
/// RefinementStep::distance is the root mean square over the samples s of n . (s - a), with n the
/// unit normal and a a corner of the triangle in the direction of s on the sphere. So the distance
///  - is one-sided, from the original to the mesh;
///  - is point to plane: the plane goes on beyond its triangle, and another may be nearer;
///  - holds neither the penalty for large distances nor the nodes' own distances nor small angles,
///    which are all in the sum, so it need not fall in every round, and rises by some per cent
///    while small angles are made to go.
/// It bounds no other distance. The Hausdorff distance, and any other from the mesh to the
/// original, may rise while it falls; measure_distances has both sides.
///
/// Same bytes on any number of threads. Throws Error(InvalidInput) for options out of range, what
/// the original's samples throw, Error(Cancelled).
RefinedNodes refine_nodes(std::vector<RefinementNode> nodes, SphereTriangulation triangulation,
                          const RefinementTarget& original, const RefinementOptions& options,
                          const Execution& execution);

/// Nodes over a radial map: each lies in its own direction.
std::vector<RefinementNode> radial_nodes(const std::vector<Vector3>& positions);

/// Nodes over a mapped surface that lie at `directions` there, wherever they are.
std::vector<RefinementNode> mapped_nodes(const std::vector<Vector3>& positions,
                                         const std::vector<Vector3>& directions,
                                         const MappedSurface& surface, const Execution& execution);

std::vector<Vector3> positions_of(const std::vector<RefinementNode>& nodes);

/// A report in lengths of `unit`, in plain lengths.
void scale(RefinementReport& report, double unit);

}  // namespace wscvt
