// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// One body of a mesh.
struct MeshBody {
  IndexedMesh mesh;                ///< its outer surface, outward, and its pores, inward
  double volume = 0.0;             ///< inside the outer surface, with pores; length^3
  std::size_t pores = 0;           ///< closed surfaces inside
  double pore_volume = 0.0;        ///< of the pores, length^3
  std::size_t boundary_edges = 0;  ///< of the outer surface; 0 if it is closed
  std::string name;                ///< that the file gives all its faces; empty: none

  bool is_closed() const { return boundary_edges == 0 && volume > 0.0; }
};

struct MeshBodies {
  std::vector<MeshBody> list;         ///< in the order of their first faces
  std::vector<std::string> warnings;  ///< on faces left out and corners merged, one sentence each
};

/// Splits a mesh into bodies. `names` as MeshFile has them, the coarsest first.
///
/// If the names are those of both sides of walls, each name's surface is all faces with it on one
/// side; a closed surface inside it is a pore, whichever way its faces look. Else:
///
/// 1. Faces of one name, and then faces connected through the mesh's own vertices, are a surface of
///    their own if they are closed, unless the others are open along them. All others are welded
///    together (see weld.h).
/// 2. Surfaces connected through edges bound regions (see mesh_cells.h). Each region that they
/// enclose is
///    a body. A wall has two sides, whether it is there once or twice.
/// 3. A closed surface directly inside a body is a pore of it. If it looks outward and has another
///    name than the body, it is an inclusion: a body that fills the pore. A surface inside a pore
///    is a body again, also if it fills the pore, with triangles of its own; so are regions inside
///    a body with a wall between them. Surfaces that intersect are bodies side by side.
///
/// An open surface is a body too, wherever it lies. Faces that hang on a body and enclose nothing
/// are left out up to 5 % of its area. A second copy of a body is left out. Repairs nothing else.
/// Throws Error(InvalidInput) if regions cannot be told apart, because faces lie on each other at
/// an edge of more than two, and more than 0.1 % of the area encloses nothing; as check_mesh for
/// meshes without usable faces.
MeshBodies split_bodies(IndexedMesh mesh, std::vector<NamedFaces> names,
                        const Execution& execution);

}  // namespace wscvt
