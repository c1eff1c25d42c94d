// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

/// Which weighting a mapped surface follows. A radius, or a solid angle seen from the centre, says
/// nothing about a cell there: WSCVT-D and Constant are the area weighting.
Weighting weighting_in_space(Weighting asked);

/// The wanted number of nodes per area at every vertex of a mesh, any common scale; empty for the
/// area weighting, which wants the same everywhere.
///
/// Curvatures are those of quadrics over two rings, as root mean square over caps of 0.6 h, h =
/// sqrt(area / node_count), like those of SurfaceSeedModel. WSCVT-C gives a cell the area that
/// eqs. 11 to 14 and the law "cell area = 3.118 w + C" give it on the unit sphere, with mean and
/// deviation over the surface; ErrorAdaptive the density k^exponent.
///
/// Throws Error(InvalidInput) for options out of range.
std::vector<double> densities_in_space(const IndexedMesh& mesh, const WeightingOptions& options,
                                       int node_count, const Execution& execution);

}  // namespace wscvt
