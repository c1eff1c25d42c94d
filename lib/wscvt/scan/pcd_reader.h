// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Reads the points of a file of the Point Cloud Library: text, binary or packed. Other fields than
/// x, y and z are passed over; points without a finite place, which clouds in rows have where
/// nothing was seen, are left out with a warning. Throws as read_mesh.
IndexedMesh read_pcd(ByteReader& reader);

}  // namespace wscvt
