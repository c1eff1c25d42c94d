// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Flips edges if this lowers the sum of error, springs, degrees and small angles (as in the mesh
/// optimization of Hoppe et al. 1993, but once over all edges in order). An edge may become as
/// sharp as the scan if its triangles face as their samples do. Early rounds accept small angles if
/// two triangles have many mean errors; later rounds repair them. An edge that closes a notch in a
/// rim is flipped in whatever its springs cost. Returns the number of flips.
int flip_for_fit(FitState& state);

}  // namespace wscvt
