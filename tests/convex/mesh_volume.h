// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

/// The volume of a closed mesh.
inline double volume_of(const IndexedMesh& mesh) {
  return mesh_sums(mesh.points, mesh.triangles, mesh.points.front(), Execution(1)).volume();
}

}  // namespace wscvt
