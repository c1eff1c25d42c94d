// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
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

}  // namespace wscvt
