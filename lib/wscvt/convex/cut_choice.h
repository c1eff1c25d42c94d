// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/convex/body_cut.h"
#include "wscvt/convex/convex_body.h"
#include "wscvt/convex/signed_grid.h"

namespace wscvt {

/// What a convex hull costs that stands for pieces of a grain: its volume beyond that of the
/// pieces, times the square root of its largest distance from the grain. Volume alone leaves deep
/// narrow dents, distance alone shallow wide ones (tests/study/convex.md).
class HullCost {
 public:
  /// `grid` is about the whole grain, and must outlive this. Distances below `tolerance` (length)
  /// count as much.
  HullCost(const SignedGrid& grid, double tolerance);

  /// Of a hull, for pieces of this volume; length^3.5. Not for an empty body.
  double operator()(const ConvexBody& body, double volume) const;

  /// The largest distance from a hull to the surface of the grain, of places outside the grain;
  /// length. Taken at points of the hull's faces two of the grid's spacings apart.
  double distance(const ConvexBody& body) const;

  double tolerance() const { return tolerance_; }

  /// Points nearer to a plane lie in it; length.
  double on_plane() const { return 1e-9 * grid_->spacing(); }

 private:
  const SignedGrid* grid_;
  double tolerance_;
};

/// The planes to cut a piece with, the best first: of slices along the grain's axes, of planes
/// through the deepest dents and along reflex edges those with the smallest sum of the costs of the
/// hulls on both sides, each to the power `power`. With 1 a cut that gains nothing at once is not
/// made, such as the first across a ring; above 1 even halves are better. `axes` has the axes as
/// columns. The same on any number of threads.
std::vector<CutPlane> best_cuts(const CutSolid& solid, const ConvexBody& body,
                                const Eigen::Matrix3d& axes, const HullCost& cost, double power,
                                const Execution& execution);

}  // namespace wscvt
