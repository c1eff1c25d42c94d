// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

class MappedSurface;

/// Fits x, y and z over the mapped scan by least squares, weighted by the scan's area: one matrix
/// with three right-hand sides. Quadrature over the faces uses points closer than half a radian /
/// degree, so the result depends on the surface and its map, not on its triangulation.
///
/// The degree is lowered until there are at least two points per coefficient and the condition is
/// at most 1000. Throws Error(InvalidInput) if the degree is not in [0, 60] or the surface has no
/// area, and Error(NumericalFailure) if even degree 0 has no solution.
HarmonicMap fit_harmonic_map(const MappedSurface& surface, int degree, const Execution& execution);

}  // namespace wscvt
