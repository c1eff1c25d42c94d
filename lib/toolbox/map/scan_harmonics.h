// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

/// Computes the coefficients of an SH series of a closed scan about the origin, in its units: of
/// the radius if rays from the origin see all of it, else of x, y and z over its map to the sphere.
/// Throws Error: InvalidInput for a degree out of range and for a scan with handles that rays do
/// not see whole, NumericalFailure, Cancelled.
SeriesCoefficients scan_harmonics(const IndexedMesh& scan, int degree, const Execution& execution);

}  // namespace wscvt
