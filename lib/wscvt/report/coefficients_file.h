// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/report/remesh_result.h"

namespace wscvt {

/// Writes the coefficients of a result as write_harmonics or write_harmonic_map does, whichever map
/// it has. A Spherical result needs `measures.coefficients`. Throws Error: InvalidInput for a
/// result without coefficients, and what those throw.
void write_coefficients(const std::string& path, const RemeshResult& result);

}  // namespace wscvt
