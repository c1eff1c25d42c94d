// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// One body of a mesh.
struct MeshBody {
  IndexedMesh mesh;                ///< its outer surface, outward, and its pores, inward
  double volume = 0.0;             ///< inside the outer surface, with pores; length^3
  std::size_t pores = 0;           ///< closed surfaces inside
  double pore_volume = 0.0;        ///< of the pores, length^3
  std::size_t boundary_edges = 0;  ///< of the outer surface; 0 if it is closed
};

/// Splits a mesh into parts connected through edges, in the order of their first faces. A closed
/// part directly inside another part is a pore of that part. A part inside a pore is a body again.
/// Parts that intersect each other are separate bodies. An open part is also a body, wherever it
/// lies. Welds equal points and drops faces with two equal corners, as check_mesh does. Repairs
/// nothing else. Throws as check_mesh for meshes without usable faces.
std::vector<MeshBody> split_bodies(IndexedMesh mesh, const Execution& execution);

}  // namespace wscvt
