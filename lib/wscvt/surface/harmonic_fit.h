// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/sphere_surface.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

struct HarmonicFit {
  HarmonicSurface surface;
  HarmonicFitReport report;
};

/// The series of `degree` that is nearest to a surface r(u): the least squares of the radii over
/// the sphere (the paper, eq. 5, with an integral in the place of the sum over a scan's vertices).
///
/// Harmonics are orthonormal, so the coefficients are integrals, a_lm = integral of r Y_lm dOmega,
/// here by Gauss-Legendre quadrature, and do not depend on each other or on the degree. What is
/// read is the surface, not the vertices it happens to have: a mesh whose faces are split gives the
/// same series, and eight vertices give that of a cube. The grid has four rows a degree, 96 at
/// least, and is doubled until the volume it sees stays within 1e-3 or it has 768 rows.
///
/// The degree is lowered, one by one, until the series is positive on a fine grid. The residual is
/// measured from 3,000 points of the surface, each to the nearest point of the series: within 2 %
/// of what dense sampling gives on nine scans that do not fold, 6 % where one is pressed flat
/// (2 : 1 : 0.4), and up to 10 % too large for slabs with sharp edges. Of what lies behind another
/// sheet no ray tells: where a scan folds, the residual is too small.
///
/// Throws Error(InvalidInput) for a degree not in [0, 60] or a surface whose radii are not positive
/// and finite, NumericalFailure when the series is positive at no degree, Cancelled, and what the
/// surface throws.
HarmonicFit fit_harmonics(const RadialSurface& surface, int degree, const Execution& execution);

/// A report in lengths of `unit`, in plain lengths.
void scale(HarmonicFitReport& report, double unit);

}  // namespace wscvt
