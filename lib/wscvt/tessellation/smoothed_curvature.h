// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

/// Combines a pair of principal curvatures into one number whose square is averaged.
using CurvatureSquare = double (*)(const PrincipalCurvatures&);

/// Returns the root mean square of the surface's curvature over caps of 0.6 h about the nodes of
/// the table's grid, h = sqrt(4 pi / N). Cells cannot follow finer detail, which would keep the
/// iteration from settling.
GridField smoothed_curvature(const TabulatedSurface& table, CurvatureSquare square,
                             const Execution& execution);

}  // namespace wscvt
