// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads an STL file, binary or text, in upper or lower case. A binary file may begin with "solid".
/// Warns about extra bytes at its end, fewer than a triangle takes. Each triangle has three points
/// of its own. Throws as read_mesh; a file without triangles is an error.
///
/// CGAL, which writes STL here, is not used for reading: it reads a text that breaks off as an
/// empty file, and does not read capital letters.
IndexedMesh read_stl(ByteReader& reader);

/// Reads an STL file as read_stl, and appends the names of the solids of a text.
IndexedMesh read_stl_solids(ByteReader& reader, std::vector<NamedFaces>& names);

}  // namespace wscvt
