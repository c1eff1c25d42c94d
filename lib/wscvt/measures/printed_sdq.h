// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// Computes Sdq as the paper prints it (eq. 17): ((1/A) integral over theta in [0, pi] and phi in
/// [0, 2 pi] of (r_theta^2 + r_phi^2) dtheta dphi)^(1/2), theta the polar angle about z. No unit.
/// It changes if a grain is rotated, because the meridians crowd at the poles: by 1 to 12 % over
/// four poses of the grains in meshes/, fitted at degree 20 (tests/figures/study/README.md,
/// roughness.csv). ShapeDescriptors::sdq does not change. Midpoint rule on `rings` parallels of 2
/// `rings` azimuths; area by the same rule. Throws Error(InvalidInput) if rings < 1.
double printed_sdq(const RadialSurface& surface, int rings, const Execution& execution);

}  // namespace wscvt
