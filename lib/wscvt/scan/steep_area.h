// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A surface is steep where its normal turns from the radius by more than this, in degrees.
inline constexpr double steep_angle = 75.0;

/// Fraction of the area of a closed, outward mesh that is steep as seen from `centre`, or looks
/// back at it. A face is judged as a whole, at its middle. Throws Error(Cancelled).
double steep_area_fraction(const IndexedMesh& mesh, const Vector3& centre,
                           const Execution& execution);

}  // namespace wscvt
