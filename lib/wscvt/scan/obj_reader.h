// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Reads the vertices and faces of an OBJ file: polygons, indices with texture and normal, counted
/// from the end when negative, lines continued by a backslash. Lines, groups, materials and the
/// like are passed over. A file without faces gives points alone. Throws as read_mesh.
///
/// The library that the writer comes from stops in silence at the first line it does not know,
/// which makes half a scan out of a whole one.
IndexedMesh read_obj(ByteReader& reader);

/// Reads an OBJ file as read_obj, with red, green and blue of its vertices, if three numbers from 0
/// to 1 follow each one's coordinates, and with its texture, if faces name places (vt) and a
/// library of materials is named. `libraries` become the names of these.
IndexedMesh read_obj_attributes(ByteReader& reader, MeshAttributes& attributes,
                                std::vector<std::string>& libraries);

}  // namespace wscvt
