// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Solid angle of all sheets beyond the first that rays from `centre` meet, / 4 pi: the solid
/// angles of the faces of the closed mesh, taken without sign, add up to 4 pi (1 + fold). A fold
/// counts with both its sheets, the one that looks back and the one behind it. 0 for a star-shaped
/// mesh; at least 1 when `centre` lies outside or on a face.
double folded_solid_angle(const IndexedMesh& mesh, const Vector3& centre,
                          const Execution& execution);

}  // namespace wscvt
