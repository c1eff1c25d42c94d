// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Flips edges where error, springs, degrees and small angles fall together (as in the mesh
/// optimization of Hoppe et al. 1993, but once over all edges in order). An edge may become as
/// sharp as the scan: its triangles then have to look where their samples do. Where two triangles
/// hold many mean errors small angles pass, for later rounds to heal; and an edge that closes a
/// notch in a rim is taken whatever its springs say. Returns how many were flipped.
int flip_for_fit(FitState& state);

}  // namespace wscvt
