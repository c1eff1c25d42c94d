// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/tessellation/tessellation_options.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

/// Returns whether a sampling exists for any number of points.
bool takes_any_count(Sampling sampling);

/// Returns the points of a sampling that is not relaxed: `count` of them, or the nearest possible
/// number (see takes_any_count). Unit vectors. Throws Error(InvalidInput) for Sampling::Weighted.
std::vector<Vector3> unrelaxed_seeds(Sampling sampling, int count);

/// Returns `count` >= 4 unit vectors from which the relaxation starts: a Fibonacci lattice warped
/// to the density that `model` wants.
std::vector<Vector3> start_seeds(const SurfaceSeedModel& model, int count,
                                 const Execution& execution);

}  // namespace wscvt
