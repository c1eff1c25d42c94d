// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

/// How a pair of principal curvatures is made one number whose square is averaged.
using CurvatureSquare = double (*)(const PrincipalCurvatures&);

/// Root mean square of the surface's curvature over caps of 0.6 h about the
/// nodes of the table's grid, h = sqrt(4 pi / N). Detail finer than the cells cannot be followed by
/// them and keeps the iteration from settling.
GridField smoothed_curvature(const TabulatedSurface& table, CurvatureSquare square,
                             const Execution& execution);

}  // namespace wscvt
