// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Reads a PLY file: text or binary of either byte order; coordinates and indices of any scalar
/// type; faces and triangle strips; other elements and properties are passed over. A file without
/// faces gives points alone. Throws as read_mesh.
///
/// The library that the other formats' writers come from reads through a null pointer when
/// coordinates are whole numbers or a property stands before the first element, believes the counts
/// of lists, and takes eleven times as long.
IndexedMesh read_ply(ByteReader& reader);

/// Reads a PLY file as read_ply, with the numbers at its vertices and faces: every property that is
/// no list, no coordinate, normal, texture coordinate or flag. Triangles of a polygon have the
/// polygon's numbers; triangle strips have none.
///
/// If the header names pictures (comment TextureFile), their places become the texture: of the
/// faces' corners (lists texcoord with texnumber, as MeshLab writes), or of the vertices (s and t,
/// u and v, texture_u and texture_v).
IndexedMesh read_ply_attributes(ByteReader& reader, MeshAttributes& attributes);

}  // namespace wscvt
