// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// Roundness after Wadell (1932, "Volume, shape, and roundness of rock particles", J. Geol. 40,
/// 443-451): mean radius of curvature of the corners over the radius R of the largest inscribed
/// sphere. In three dimensions, with curvature in place of fitted circles as in Zhao and Wang
/// (2016, "3D quantitative shape analysis on form, roundness, and compactness with micro-CT",
/// Powder Technology), this library reads it as: corners are the points whose larger principal
/// curvature k (positive where convex) exceeds 1/R, and
///   roundness = (1 / (R A_c)) integral over the corners of (1 / k) dA,   A_c their area.
/// So every corner's radius lies below R and a sphere has 1. Curvature depends on how much detail
/// the surface holds: name its degree beside the figure.
///
/// `inscribed_radius` > 0 in the length of the surface. Integrated at `polar_nodes` Gauss-Legendre
/// nodes in cos(theta) times twice as many azimuths. Throws Error(InvalidInput) for a radius or
/// number of nodes that is not positive.
Roundness wadell_roundness(const SphereSurface& surface, double inscribed_radius, int polar_nodes,
                           const Execution& execution);

}  // namespace wscvt
