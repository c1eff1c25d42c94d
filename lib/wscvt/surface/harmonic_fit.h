// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/radial_surface.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

struct HarmonicFit {
  HarmonicSurface surface;
  HarmonicFitReport report;
};

/// Fits the series of `degree` to a surface r(u) by least squares of the radii over the sphere (the
/// paper, eq. 5, with an integral instead of the sum over a scan's vertices).
///
/// Harmonics are orthonormal, so the coefficients are integrals, a_lm = integral of r Y_lm dOmega,
/// computed by Gauss-Legendre quadrature. They do not depend on each other or on the degree. The
/// fit depends on the surface, not on its vertices: a mesh with split faces gives the same series,
/// and a cube needs only its eight vertices. The grid has four rows per degree, at least 96. It is
/// doubled until its volume changes by at most 1e-3 or it has 768 rows.
///
/// The degree is lowered in steps of one until the series is positive on a fine grid. The residual
/// is measured from 3,000 points of the surface, each to the nearest point of the series. Compared
/// with dense sampling, it is within 2 % on nine scans without overhangs, within 6 % if a scan is
/// pressed flat (2 : 1 : 0.4), and up to 10 % too large for slabs with sharp edges. Overhangs are
/// not measured: on scans with overhangs the residual is too small.
///
/// Throws Error(InvalidInput) if the degree is not in [0, 60] or the radii are not positive and
/// finite, NumericalFailure if the series is positive at no degree, Cancelled, and as the surface.
HarmonicFit fit_harmonics(const RadialSurface& surface, int degree, const Execution& execution);

/// Converts a report in units of length `unit` to plain lengths.
void scale(HarmonicFitReport& report, double unit);

}  // namespace wscvt
