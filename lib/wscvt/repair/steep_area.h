// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A surface is steep if the angle between its normal and the radius is larger than this, in
/// degrees.
inline constexpr double steep_angle = 75.0;

/// Returns the fraction of the area of a closed, outward mesh that is steep as seen from `centre`
/// or faces it. Judges each face as a whole, at its centroid. Throws Error(Cancelled).
double steep_area_fraction(const IndexedMesh& mesh, const Vector3& centre,
                           const Execution& execution);

}  // namespace wscvt
