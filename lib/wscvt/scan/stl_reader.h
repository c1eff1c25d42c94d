// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Reads an STL file, binary or text, in either case of its letters; a binary one may begin with
/// the word "solid", and end with less bytes than a triangle takes,
/// of which it warns. The corners of each triangle come back as points of their own. Throws as
/// read_mesh; a file without triangles is an error.
///
/// The library that the writer comes from takes a text that breaks off for an empty file, and does
/// not know capitals.
IndexedMesh read_stl(ByteReader& reader);

}  // namespace wscvt
