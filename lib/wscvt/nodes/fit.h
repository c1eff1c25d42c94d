// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Counts of fit_to_samples.
struct SurfaceFitReport {
  int rounds = 0;
  int flips = 0;
  int relocations = 0;
  int polished = 0;  ///< moves of single nodes
  int mending = 0;   ///< final passes that enlarged small angles
};

/// Fits a mesh to the samples of a scan. Nodes move, edges are flipped and nodes relocated while
/// the distance falls and the evenness of the triangles stays near the wanted one. One weight,
/// between even and close, is controlled by the mean edge ratio reached. Throws Error(Cancelled).
/// The result does not depend on the number of threads.
SurfaceFitReport fit_to_samples(FitState& state, const Execution& execution);

}  // namespace wscvt
