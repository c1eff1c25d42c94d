// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Moves all points of a closed, outward mesh along their normals by one distance, so that it
/// encloses `volume` > 0 to rounding. Returns the distance, > 0 outwards; length. If the mesh is
/// far from this volume, scales it about its centroid and returns the mean distance. Leaves a mesh
/// whose own volume is not positive unchanged.
double offset_to_volume(std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                        double volume);

}  // namespace wscvt
