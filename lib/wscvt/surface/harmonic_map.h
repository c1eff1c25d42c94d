// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

class MappedSurface;

/// How the fit of a harmonic map went.
struct HarmonicMapReport {
  int requested_degree = 0;
  int degree = 0;  ///< lowered when the surface cannot carry the requested one
  DegreeLimit limit = DegreeLimit::None;
  std::size_t points = 0;  ///< of the quadrature over the faces
  double residual = 0.0;   ///< rms over the area of the distance of equal directions, length
  double condition = 0.0;  ///< estimate for the equations, which all coordinates share
  /// Share of the series' area that looks the other way than the scan there: folds, at edges and
  /// limbs that the degree is too low for.
  double turned_area_share = 0.0;
};

/// A series and how its fit went.
struct HarmonicMapFit {
  HarmonicMap map;
  HarmonicMapReport report;
};

/// Least squares for x, y and z over the mapped scan, weighted by the scan's area: one matrix with
/// three right-hand sides. Faces enter by quadrature, points closer than half a radian over the
/// degree, so the result depends on the surface and its map and not on how it is triangulated.
///
/// The degree is lowered until the surface carries it: at least two points a coefficient and a
/// condition of at most 1000. Throws Error(InvalidInput) for a degree not in [0, 60] and a surface
/// without area, Error(NumericalFailure) when not even degree 0 has a solution.
HarmonicMapFit fit_harmonic_map(const MappedSurface& surface, int degree,
                                const Execution& execution);

}  // namespace wscvt
