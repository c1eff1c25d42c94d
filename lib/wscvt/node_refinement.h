// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/execution.h"
#include "wscvt/mesh.h"
#include "wscvt/mesh_surface.h"
#include "wscvt/sphere_triangulation.h"

namespace wscvt {

struct RefinementOptions {
  int rounds = 0;                ///< at most so many, in [0, 1000]; 0: nothing is done
  double smallest_angle = 15.5;  ///< no triangle is given a smaller one; degrees, in [0, 40]
  double tolerance = 2e-3;       ///< stop when a round gains less than this share; in [0, 1)
};

/// One line of the refinement's history.
struct RefinementStep {
  double distance = 0.0;  ///< rms distance from the samples to the mesh after the round; length
  int moves = 0;          ///< nodes moved
  int flips = 0;          ///< edges flipped
  int relocations = 0;    ///< nodes taken from where they help least to where they help most
};

struct RefinementReport {
  bool converged = false;       ///< the last round lowered the distance by less than the tolerance
  double start_distance = 0.0;  ///< rms distance before the first round; length
  std::vector<RefinementStep> history;
};

struct RefinedNodes {
  std::vector<Vector3> positions;     ///< about the origin
  SphereTriangulation triangulation;  ///< of their directions
  RefinementReport report;
};

/// Throws Error(InvalidInput) for options out of range.
void check_refinement_options(const RefinementOptions& options);

/// Brings a mesh nearer to the original at the same number of nodes.
///
/// What is lowered is the sum of squared distances from points spread evenly over the original to
/// the plane of the triangle in their direction, after Hoppe et al. 1993, "Mesh optimization", with
/// distances far above the rms counted more, and the nodes' own distances added. A round
///  - moves every node, in all three dimensions, by a Gauss-Newton step in the triangles about it,
///    so that nodes slide on to ridges by themselves;
///  - flips edges, the most rewarding first;
///  - takes nodes from where they help least (their triangles joined to a neighbour) to where they
///    help most (an edge split), as long as that pays.
/// Nothing is done that does not lower the sum, turns a triangle over on the sphere of directions,
/// or makes the smallest angle of the triangles concerned smaller than the limit, or than before
/// where it is below the limit already. So the mesh stays closed and star-shaped about the origin.
/// Where the start has smaller angles than the limit, edges are flipped and nodes moved towards the
/// middle of their neighbours first.
///
/// `positions` are about the origin, on a triangulation of their directions. Same bytes on any
/// number of threads. Throws Error(InvalidInput) for options out of range, Error(Cancelled).
RefinedNodes refine_nodes(std::vector<Vector3> positions, SphereTriangulation triangulation,
                          const MeshSurface& original, const RefinementOptions& options,
                          const Execution& execution);

}  // namespace wscvt
