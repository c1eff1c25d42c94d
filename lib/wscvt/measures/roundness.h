// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Computes roundness after Wadell (1932, "Volume, shape, and roundness of rock particles", J.
/// Geol. 40, 443-451): mean radius of the corners over the radius R of the largest inscribed
/// sphere. In two dimensions Zheng and Hryciw (2015, Geotechnique 65, 494-506) fit circles to the
/// corners of an outline. In three, Nie et al. (2018, "A new roundness index based on local
/// curvature", Powder Technol. 335, 58-66) use curvature, as does this library.
///
/// Convention: corners are the points whose larger principal curvature k exceeds 1.05 / R. The mean
/// over them weights each radius 1/k by the turn k dA that it makes:
///   V = A_c / (R integral over the corners of k dA),   A_c their area.
/// Another weight gives another number: an ellipsoid 1 : 2 : 6 has 0.54 by turn, 0.61 by area. A
/// rounded cube of edge radius a has V = a / R for any weight.
///
/// Curvature in balls of radius s (ball_curvatures) conserves the turn but spreads a corner over
/// the ball, so V(s) grows linearly with s. Hence
///   V = V(s) - 2 (V(1.5 s) - V(s)),   at least V(s) - 0.7 (s / R) (1 - V(s)).
/// If corners cover less than 1 % of the area, roundness is 1.
///
/// `ball` is s / R in (0, 1]; s is at least 2.5 mean edges of the mesh. The smallest corner radius
/// that can be distinguished from sharper corners, to within 0.03 R, is s / 4 (measured on cubes of
/// edge radius 0.02 to 1 at 1,000 to 20,000 vertices). If s / R exceeds 1, roundness is NaN.
/// Measures at most 5,000 places, chosen at random with a fixed seed, one in each equal part of the
/// area. On seven scans this changes roundness by at most 0.006. Works on any closed body.
///
/// Throws Error(InvalidInput) if the inscribed radius or the ball is not positive.
Roundness wadell_roundness(const IndexedMesh& mesh, double inscribed_radius, double ball,
                           const Execution& execution);

}  // namespace wscvt
