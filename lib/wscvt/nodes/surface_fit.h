// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// What a fit did.
struct SurfaceFitReport {
  int rounds = 0;
  int flips = 0;
  int relocations = 0;
  int polished = 0;  ///< moves of single nodes
  int mending = 0;   ///< passes that mended small angles in the end
};

/// Fits a mesh to the samples of a scan: nodes move, edges are flipped and nodes relocated while
/// the distance falls and the evenness of the triangles stays near what the dial wants. Led by one
/// weight, between even and close, that follows the mean edge ratio reached. Cancels by
/// Error(Cancelled). The same on any number of threads.
SurfaceFitReport fit_to_samples(FitState& state, const Execution& execution);

}  // namespace wscvt
