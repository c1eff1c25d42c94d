// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads points from a text, one per line: x, y, z and ignored columns, separated by blanks, tabs,
/// commas or semicolons. Skips empty lines and lines that begin with #. The first line may name the
/// columns. Columns x, y and z (or Points:0 to Points:2, as ParaView names them) are then read, in
/// any position and case. Throws as read_mesh.
IndexedMesh read_point_text(ByteReader& reader);

}  // namespace wscvt
