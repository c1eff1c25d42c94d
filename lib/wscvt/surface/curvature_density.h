// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the density of nodes that WSCVT-C wants at every vertex of a surface, mean over the area
/// 1; empty on a sphere. A cell is the fraction of the mean cell that eqs. 11 to 14 and the law
/// "cell area = 3.118 w + C" of the paper (see remesh.h) give on the unit sphere, with mean and
/// deviation over the surface.
///
/// Curvature is the largest of quadrics fitted to two rings, as root mean square over discs of
/// 0.6 h, h = sqrt(area / node_count). `alpha`: -3 to 3. Throws Error(Cancelled).
std::vector<double> curvature_density(const IndexedMesh& surface, double alpha, int node_count,
                                      const Execution& execution);

/// Returns a density to a power, divided by its mean over the surface's area. Empty stays empty.
std::vector<double> steepened(std::vector<double> density, const IndexedMesh& surface,
                              double power);

}  // namespace wscvt
