// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads a PLY file: text or binary in either byte order, coordinates and indices of any scalar
/// type, faces and triangle strips. Skips other elements and properties. A file without faces gives
/// only points. Throws as read_mesh.
///
/// CGAL, which writes other formats here, is not used for reading. It reads through a null pointer
/// if coordinates are integers or a property precedes the first element, trusts the counts of
/// lists, and takes eleven times as long.
IndexedMesh read_ply(ByteReader& reader);

/// Reads a PLY file as read_ply, with the numbers at its vertices and faces: every property that is
/// not a list, coordinate, normal, texture coordinate or flag. Triangles of a polygon get the
/// polygon's numbers. Triangle strips get no numbers.
///
/// If the header names pictures (comment TextureFile), also reads the texture coordinates: of the
/// faces' corners (lists texcoord with texnumber, as MeshLab writes), or of the vertices (s and t,
/// u and v, texture_u and texture_v).
IndexedMesh read_ply_attributes(ByteReader& reader, MeshAttributes& attributes);

}  // namespace wscvt
