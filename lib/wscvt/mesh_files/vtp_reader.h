// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads the polygons and strips of VTK's XML PolyData, all pieces: ascii, base64 or appended,
/// plain or by ZLib. Skips vertices, lines and the data of points and faces. A file without faces
/// gives only points. Throws as read_mesh.
IndexedMesh read_vtp(ByteReader& reader);

}  // namespace wscvt
