// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// One of the bodies that a mesh holds.
struct MeshBody {
  IndexedMesh mesh;                ///< its outer surface, turned outward, and its pores, inward
  double volume = 0.0;             ///< within the outer surface, pores included; length^3
  std::size_t pores = 0;           ///< closed surfaces inside
  double pore_volume = 0.0;        ///< of them, length^3
  std::size_t boundary_edges = 0;  ///< of the outer surface; it is open where there are any
};

/// Parts a mesh into what hangs together by edges, in the order of the first faces. A closed part
/// inside another, which no third lies between, is a pore of that one; one inside a pore is a body
/// again. Parts that cut through each other are bodies side by side, and so is an open part,
/// wherever it lies. Equal points are welded and faces with two corners in one place dropped, as
/// check_mesh does; nothing else is mended. Throws as check_mesh for meshes without usable faces.
std::vector<MeshBody> split_bodies(IndexedMesh mesh, const Execution& execution);

}  // namespace wscvt
