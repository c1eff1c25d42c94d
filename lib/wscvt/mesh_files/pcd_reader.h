// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads the points of a file of the Point Cloud Library: text, binary or packed. Skips all fields
/// except x, y and z. Leaves out points without a finite position, with a warning; clouds in rows
/// have such points where nothing was seen. Throws as read_mesh.
IndexedMesh read_pcd(ByteReader& reader);

}  // namespace wscvt
