// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/scan_nodes_options.h"

namespace wscvt {

/// Returns the density of nodes that a weighting wants at every vertex of a surface, mean over the
/// area 1; empty for CellWeighting::Area, whose density is uniform.
///
/// Curvature is of quadrics fitted to two rings, as root mean square over discs of 0.6 h, h =
/// sqrt(area / node_count). WSCVT-C gives a cell the fraction of the mean cell that eqs. 11 to 14
/// and the law "cell area = 3.118 w + C" of the paper (see remesh.h) give on the unit sphere, with
/// mean and deviation over the surface. Error-adaptive uses the density k^(2/3) for a curvature k,
/// which distributes the error of flat triangles evenly.
std::vector<double> node_densities(const IndexedMesh& surface, CellWeighting weighting,
                                   double curvature_alpha, int node_count,
                                   const Execution& execution);

/// Returns a density to a power, divided by its mean over the surface's area, and at most `most`.
/// Empty stays empty.
std::vector<double> steepened(std::vector<double> density, const IndexedMesh& surface, double power,
                              double most);

}  // namespace wscvt
