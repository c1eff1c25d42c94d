// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/mesh.h"

namespace wscvt {

/// Reads a triangle mesh into flat arrays; polygons are cut into fans. The format follows from the
/// extension: PLY, STL, OBJ, OFF. Throws Error(InputOutput) when the file cannot be read or its
/// format is not known.
IndexedMesh read_mesh(const std::string& path);

/// Writes a mesh, in the format of the extension (PLY binary, STL binary, OBJ, OFF), whole or not
/// at all: it is written beside the target and renamed. Throws Error(InputOutput).
void write_mesh(const IndexedMesh& mesh, const std::string& path);

}  // namespace wscvt
