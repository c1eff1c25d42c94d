// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Moves all points of a closed, outward mesh along their normals by one distance, so that it holds
/// `volume` to rounding. Returns the distance, > 0 outwards; length. The mesh must be near that
/// volume already.
double offset_to_volume(std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                        double volume);

}  // namespace wscvt
