// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Triangles of the Delaunay triangulation of finite unit vectors on the sphere (CGAL's), in no
/// order; empty when they do not cover the sphere or a seed is lost, because CGAL takes it for a
/// neighbour. A million seeds take seconds on the one thread that `execution` reports from.
std::vector<Triangle> sphere_delaunay(const std::vector<Vector3>& seeds,
                                      const Execution& execution);

}  // namespace wscvt
