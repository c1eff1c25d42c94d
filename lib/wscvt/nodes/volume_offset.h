// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Moves all points of a closed, outward mesh along their normals by one distance, so that it holds
/// `volume` > 0 to rounding. Returns the distance, > 0 outwards; length. A mesh that is far from
/// that volume is scaled about its centroid instead; returned is the mean distance then. One whose
/// own volume is not positive is left as it is.
double offset_to_volume(std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                        double volume);

}  // namespace wscvt
