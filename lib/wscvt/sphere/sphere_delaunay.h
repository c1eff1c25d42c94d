// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the triangles of CGAL's Delaunay triangulation of finite unit vectors on the sphere, in
/// no order. Empty if they do not cover the sphere, or if CGAL merges a seed with a neighbour. Uses
/// the one thread that `execution` reports from; a million seeds take seconds.
std::vector<Triangle> sphere_delaunay(const std::vector<Vector3>& seeds,
                                      const Execution& execution);

}  // namespace wscvt
