// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// Measures roughness from the radii at `polar_nodes` Gauss-Legendre nodes in cos(theta) times
/// twice as many azimuths. Where Sq is below 1e-12 of the mean radius there is no roughness to
/// speak of and Ssk and Sku are 0. Throws Error(InvalidInput) unless 0 <= degree < polar_nodes and
/// degree <= 60, or when a radius is not positive and finite; Error(NumericalFailure) when no
/// series can be fitted (see fit_harmonics).
Roughness radial_roughness(const RadialSurface& surface, int degree, int polar_nodes,
                           const Execution& execution);

/// Sdq as the paper prints it (eq. 17): ((1/A) integral over theta in [0, pi] and phi in [0, 2 pi]
/// of (r_theta^2 + r_phi^2) dtheta dphi)^(1/2), theta the polar angle about z. No unit. It changes
/// when a grain is rotated, since the meridians crowd at the poles: by 1 to 12 % over four poses
/// of the grains in meshes/, fitted at degree 20 (tests/study/README.md, roughness.csv).
/// ShapeDescriptors::sdq is the form that does not change. Midpoint rule on `rings` parallels of 2
/// `rings` azimuths; area by the same rule. Throws Error(InvalidInput) if rings < 1.
double printed_sdq(const RadialSurface& surface, int rings, const Execution& execution);

}  // namespace wscvt
