// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/mesh_surface.h"

namespace wscvt {

struct RefinementOptions {
  int rounds = 0;                ///< at most so many; 0: nothing is done
  double smallest_angle = 15.5;  ///< no triangle is given a smaller one; degrees
  double tolerance = 2e-3;       ///< stop when a round gains less than this share
};

inline constexpr NumberOption<int> refinement_rounds_option = {
    "refine",
    "number of refinement rounds",
    0,
    1000,
    Ends::Both,
    "moving nodes and flipping edges towards the scan; 0 for none; needs least squares"};
inline constexpr NumberOption<double> refinement_angle_option = {
    "refine-angle", "smallest angle that the refinement makes, in degrees", 0.0, 40.0};
inline constexpr NumberOption<double> refinement_tolerance_option = {
    "refine-tolerance", "share below which the gain of a refinement round is the last", 0.0, 1.0,
    Ends::NotMaximum};

/// One line of the refinement's history.
struct RefinementStep {
  /// The distance after the round, see refine_nodes; length.
  double distance = 0.0;
  int moves = 0;        ///< nodes moved
  int flips = 0;        ///< edges flipped
  int relocations = 0;  ///< nodes taken from where they help least to where they help most
};

struct RefinementReport {
  /// The last round's moves, flips and relocations lowered the square root of the sum that is
  /// lowered by less than the tolerance, as a share of it.
  bool converged = false;
  double start_distance = 0.0;  ///< as RefinementStep::distance, before the first round; length
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
/// distances far above the rms counted more (d^2 + d^4 / (3 rms)^2, rms that of the round's start),
/// and the nodes' own distances to the original's tangent plane added. A round
///  - moves every node, in all three dimensions, by a Gauss-Newton step in the triangles about it,
///    so that nodes slide on to ridges by themselves;
///  - flips edges, the most rewarding first;
///  - takes nodes from where they help least (their triangles joined to a neighbour) to where they
///    help most (an edge split), as long as that pays.
/// Nothing is done that does not lower the sum, turns a triangle over on the sphere of directions,
/// or makes the smallest angle of the triangles concerned smaller than the limit, or than before
/// where it is below the limit already. So the mesh stays closed and star-shaped about the origin.
/// Where the mesh has smaller angles than the limit, a round begins with flipping edges and moving
/// nodes towards the middle of their neighbours, whatever that does to the sum.
///
/// This is a descent. It does not alternate with the relaxation: nothing in it strives for
/// centroidal cells or even triangles, and the angle limit is all that guards the shape.
///
/// RefinementStep::distance is the root mean square over the samples s of n . (s - a), with n the
/// unit normal and a a corner of the triangle that the ray from the origin through s meets. Samples
/// that lie behind the original's outermost sheet are left out. So the distance
///  - is one-sided, from the original to the mesh;
///  - is point to plane: the plane goes on beyond its triangle, and another may be nearer;
///  - holds neither the penalty for large distances nor the nodes' own distances, both of which are
///    in the sum, so it need not fall in every round.
/// It bounds no other distance. The Hausdorff distance, and any other from the mesh to the
/// original, may rise while it falls; measure_distances has both sides.
///
/// `positions` are about the origin, on a triangulation of their directions. Same bytes on any
/// number of threads. Throws Error(InvalidInput) for options out of range, Error(NumericalFailure)
/// when a ray from the origin meets no face of the original, Error(Cancelled).
RefinedNodes refine_nodes(std::vector<Vector3> positions, SphereTriangulation triangulation,
                          const MeshSurface& original, const RefinementOptions& options,
                          const Execution& execution);

/// A report in lengths of `unit`, in plain lengths.
void scale(RefinementReport& report, double unit);

}  // namespace wscvt
