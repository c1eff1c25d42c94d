// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/scan_nodes_options.h"

namespace wscvt {

/// The density of nodes that a weighting wants at every vertex of a surface, mean over the area 1;
/// empty for CellWeighting::Area, which wants the same everywhere.
///
/// Curvature is that of quadrics over two rings, and taken as root mean square over discs of 0.6 h,
/// h = sqrt(area / node_count). WSCVT-C gives a cell the share of the mean that eqs. 11 to 14 and
/// the law "cell area = 3.118 w + C" of the paper (see remesh.h) give it on the unit sphere, with
/// mean and deviation taken over the surface. Error-adaptive wants k^(2/3), k the curvature, which
/// spreads the error of flat triangles evenly.
std::vector<double> node_densities(const IndexedMesh& surface, CellWeighting weighting,
                                   double curvature_alpha, int node_count,
                                   const Execution& execution);

/// A density to a power, over its mean by the surface's area, and at most `most`. Empty stays
/// empty.
std::vector<double> steepened(std::vector<double> density, const IndexedMesh& surface, double power,
                              double most);

}  // namespace wscvt
