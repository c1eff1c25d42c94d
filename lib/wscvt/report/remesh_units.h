// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/report/remesh_result.h"
#include "wscvt/surface/grain.h"

namespace wscvt {

/// Turns what was measured in the grain's units, about its centre, into the input's.
void to_input_units(const Grain& grain, RemeshResult& result);

}  // namespace wscvt
