// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

// Readers of finite-element meshes, as write_mesh writes them and as others do. They take triangles
// and quadrilaterals, also of second order, by their corners. Other elements are left out, so the
// surface of a volume mesh must be in the file. Throw as read_mesh.

/// Reads a text file of Gmsh, version 2 or 4.1.
IndexedMesh read_gmsh(ByteReader& reader);

/// Reads nodes and shell elements of an Abaqus input file. Parts and instances are not moved.
IndexedMesh read_abaqus(ByteReader& reader);

}  // namespace wscvt
