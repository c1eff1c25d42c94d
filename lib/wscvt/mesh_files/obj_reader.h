// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads the vertices and faces of an OBJ file: polygons, indices with texture and normal, counted
/// from the end when negative, lines continued by a backslash. Skips lines, groups, materials and
/// the like. A file without faces gives only points. Throws as read_mesh.
///
/// CGAL, which writes OBJ here, is not used for reading: it stops silently at the first unknown
/// line and so returns a part of the scan.
IndexedMesh read_obj(ByteReader& reader);

/// Reads an OBJ file as read_obj. Also reads red, green and blue of its vertices, if
/// three numbers from 0 to 1 follow each vertex's coordinates; its texture, if faces have texture
/// coordinates (vt) and the file names a material library; the names of the libraries; and the
/// names of its objects (o) and groups (g).
IndexedMesh read_obj_attributes(ByteReader& reader, MeshAttributes& attributes,
                                std::vector<std::string>& libraries,
                                std::vector<NamedFaces>& names);

}  // namespace wscvt
