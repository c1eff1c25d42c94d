// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads an OFF file in text form. Skips normals, colours and texture coordinates (NOFF, COFF,
/// STOFF) and the colours of faces. A file without faces gives only points. Throws as read_mesh.
/// Refuses the binary form and coordinates that are not three-dimensional.
///
/// CGAL, which writes OFF here, is not used for reading: it allocates memory for as many corners as
/// a face claims, 4 GB for a file of fifty bytes.
IndexedMesh read_off(ByteReader& reader);

}  // namespace wscvt
