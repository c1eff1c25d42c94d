// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toolbox/convex/body_cut.h"
#include "toolbox/convex/convex_body.h"
#include "toolbox/convex/signed_grid.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Cost of a convex hull that represents pieces of a grain: its volume less the volume of the
/// pieces, times the square root of its largest distance from the grain. Volume alone would leave
/// deep narrow dents, distance alone shallow wide ones (tests/figures/study/convex.md).
class HullCost {
 public:
  /// `grid` covers the whole grain and must outlive this. Distances below `tolerance` (length) are
  /// raised to it.
  HullCost(const SignedGrid& grid, double tolerance);

  /// Returns the cost of a hull for pieces of this volume; length^3.5. Not for an empty body.
  double operator()(const ConvexBody& body, double volume) const;

  /// Returns the largest distance from the hull's faces, outside the grain, to the grain's surface;
  /// length. Measured at points two grid spacings apart.
  double distance(const ConvexBody& body) const;

  double tolerance() const { return tolerance_; }

  /// Points nearer to a plane than this lie in it; length.
  double on_plane() const { return 1e-9 * grid_->spacing(); }

 private:
  const SignedGrid* grid_;
  double tolerance_;
};

/// Returns the planes to cut a piece with, the best first. Candidates are slices along the grain's
/// axes, planes through the deepest dents and planes along reflex edges. The best have the smallest
/// sum of the costs of both sides' hulls. `axes` has the axes as columns. The result does not
/// depend on the number of threads.
std::vector<CutPlane> best_cuts(const CutSolid& solid, const ConvexBody& body,
                                const Eigen::Matrix3d& axes, const HullCost& cost,
                                const Execution& execution);

}  // namespace wscvt
