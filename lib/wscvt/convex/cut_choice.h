// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/convex/body_cut.h"
#include "wscvt/convex/convex_body.h"
#include "wscvt/convex/signed_grid.h"

namespace wscvt {

/// A piece of a grain, and its hull.
struct ConvexPiece {
  ExactSolid solid;
  ConvexBody body;        ///< its hull
  double volume = 0.0;    ///< of the piece
  double distance = 0.0;  ///< from the hull to the grain, see hull_distance
};

/// A piece of a mesh. `grid` is about the whole grain.
ConvexPiece convex_piece(ExactSolid solid, const SignedGrid& grid);

/// The largest distance from a hull to the surface of the grain, of places outside the grain;
/// length. Taken at points of the hull's faces two of the grid's spacings apart.
double hull_distance(const IndexedMesh& hull, const SignedGrid& grid);

/// What convex hulls cost that stand for pieces of a grain: the largest distance from the hulls to
/// the grain, and the radius of the ball of the volume that they hold too much, weighted as Wei et
/// al. (2022), "Approximate convex decomposition for 3D meshes with collision-aware concavity and
/// tree search", ACM Trans. Graph. 41 (4), weigh them. `excess_volume` may be negative by rounding.
double hull_cost(double distance, double excess_volume);

/// The planes to cut a piece with, the best first: of slices along the grain's axes, of planes
/// through the deepest dents and along reflex edges those whose two sides have hulls of the least
/// cost. `axes` has the axes as columns. The same on any number of threads.
std::vector<CutPlane> best_cuts(const ConvexPiece& piece, const Eigen::Matrix3d& axes,
                                const SignedGrid& grid, const Execution& execution);

}  // namespace wscvt
