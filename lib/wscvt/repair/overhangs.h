// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the overhang: the solid angle of all surface that rays from `centre` hit after their
/// first hit, / 4 pi. The unsigned solid angles of the faces of the closed mesh sum to 4 pi (1 +
/// overhang). An overhang counts twice: its surface that faces `centre` and the surface behind it.
/// 0 for a star-shaped mesh; at least 1 if `centre` lies outside or on a face.
double overhang_solid_angle(const IndexedMesh& mesh, const Vector3& centre,
                            const Execution& execution);

/// A surface is steep if the angle between its normal and the radius is larger than this, in
/// degrees.
inline constexpr double steep_angle = 75.0;

/// Returns the fraction of the area of a closed, outward mesh that is steep as seen from `centre`
/// or faces it. Judges each face as a whole, at its centroid. Throws Error(Cancelled).
double steep_area_fraction(const IndexedMesh& mesh, const Vector3& centre,
                           const Execution& execution);

}  // namespace wscvt
