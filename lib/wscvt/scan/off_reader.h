// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Reads an OFF file in text form, also one with normals, colours or texture coordinates (NOFF,
/// COFF, STOFF), which are passed over as are the colours of faces. A file without faces gives
/// points alone. Throws as read_mesh; the binary form and coordinates in other than three
/// dimensions are refused.
///
/// The library that the writer comes from makes room for as many corners as a face claims to have,
/// 4 GB out of fifty bytes.
IndexedMesh read_off(ByteReader& reader);

}  // namespace wscvt
