// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Reads the polygons and strips of VTK's XML PolyData, all pieces: ascii, base64 or appended,
/// plain or by ZLib. Vertices, lines and what points and faces carry are passed over. A file
/// without faces gives points alone. Throws as read_mesh.
IndexedMesh read_vtp(ByteReader& reader);

}  // namespace wscvt
