// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Reads points from a text, a line each: x, y and z, and more that is passed over, between blanks,
/// tabs, commas or semicolons. Lines that begin with # and empty ones are passed over. The first
/// line may name the columns, of which x, y and z are taken, whatever their place and case
/// (Points:0 to Points:2, as ParaView names them, too). Throws as read_mesh.
IndexedMesh read_point_text(ByteReader& reader);

}  // namespace wscvt
