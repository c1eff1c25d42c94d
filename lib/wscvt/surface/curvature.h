// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// The paper's law (see remesh.h): a relaxed cell's solid angle is this times its seed's weight,
/// plus a constant that is equal for all seeds: 2 / (5 / (9 sqrt 3)) from the second moment of the
/// regular hexagon.
inline constexpr double cell_area_per_weight = 3.118;

/// Smallest cell, as a fraction of the mean cell, for which this law is used; no cell is wanted
/// smaller.
inline constexpr double smallest_cell_share = 0.05;

/// Largest alpha x of eq. 11. Its weight is 3.6 / N, and 3.118 times this is 0.89 of the mean cell,
/// so that no wanted cell is negative. Beyond it seeds lose their cells (measured above alpha
/// 1.25).
inline constexpr double curvature_clip = 0.9;

/// Curvatures below this, in 1 / radius of the sphere of equal area, are raised to it before a
/// logarithm, because a flat face has no scale.
inline constexpr double flat_curvature = 0.01;

/// Smallest deviation of the logarithm of the curvature; below it the grain counts as a sphere. Eq.
/// 14 divides by the deviation, so on a scanned sphere it would gather the nodes by the scan's
/// noise.
inline constexpr double smallest_deviation = 0.05;

/// Computes principal curvatures at every vertex of a closed, oriented mesh (see check_mesh) by the
/// least-squares quadric z = a x^2 + b y^2 + c x y + d x + e y + f over the vertex and the vertices
/// within `rings` edges, in the frame of the angle-weighted normal (the paper, section 2.3). On
/// scans, the paper's one ring is often under-determined; the quadric of least norm is then used.
/// Two rings are the working choice. The curvature formula includes the first derivatives. 1/length
/// of the mesh, positive where convex; zero if all vertices of the ring coincide. Throws
/// Error(InvalidInput) if rings < 1.
std::vector<PrincipalCurvatures> quadric_fit_curvatures(const IndexedMesh& mesh, int rings,
                                                        const Execution& execution);

/// Returns the largest absolute principal curvature of a surface in each direction, 1 / length.
std::vector<double> largest_curvatures(const RadialSurface& surface,
                                       const std::vector<Vector3>& directions,
                                       const Execution& execution);

/// Returns the largest absolute principal curvature at the vertices of a closed mesh, by quadrics
/// over two rings, 1 / length.
std::vector<double> largest_curvatures(const IndexedMesh& mesh, const Execution& execution);

/// Returns the density of nodes that WSCVT-C wants at every vertex of a surface, mean over the area
/// 1; empty on a sphere. A cell is the fraction of the mean cell that eqs. 11 to 14 and the law
/// "cell area = 3.118 w + C" of the paper (see remesh.h) give on the unit sphere, with mean and
/// deviation over the surface.
///
/// Curvature is the largest of quadrics fitted to two rings, as root mean square over discs of
/// 0.6 h, h = sqrt(area / node_count). `alpha`: -3 to 3. Throws Error(Cancelled).
std::vector<double> curvature_density(const IndexedMesh& surface, double alpha, int node_count,
                                      const Execution& execution);

/// Returns a density to a power, divided by its mean over the surface's area. Empty stays empty.
std::vector<double> steepened(std::vector<double> density, const IndexedMesh& surface,
                              double power);

}  // namespace wscvt
