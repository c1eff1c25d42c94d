// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

/// Converts results in units of `unit` about `centre` to the input's units and coordinates.
void to_input_units(double unit, const Vector3& centre, RemeshResult& result);

}  // namespace wscvt
