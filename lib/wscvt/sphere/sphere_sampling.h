// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Directions on the unit sphere with weights that sum to 4 pi.
struct SphereQuadrature {
  std::vector<Vector3> directions;
  std::vector<double> weights;  ///< steradian
};

/// Returns Gauss-Legendre nodes in cos(theta), with an equidistant circle of 2 * polar_nodes
/// azimuths at each node. Exact for spherical harmonics of degree below 2 * polar_nodes. Throws
/// Error(InvalidInput) if polar_nodes < 1.
SphereQuadrature gauss_legendre_sphere(int polar_nodes);

/// Nodes, in descending order, and weights of Gauss-Legendre quadrature on [-1, 1]. gauss_legendre
/// throws Error(InvalidInput) if count < 1.
struct GaussLegendre {
  std::vector<double> nodes;
  std::vector<double> weights;
};
GaussLegendre gauss_legendre(int count);

/// Returns the Fibonacci lattice of `count` points: z = 1 - (2 i + 1)/count, azimuth advancing by
/// the golden angle (Gonzalez 2010, Math. Geosci. 42, 49-64). Throws Error(InvalidInput) if count <
/// 1.
std::vector<Vector3> fibonacci_lattice(int count);

/// Returns `count` independent directions, uniform on the sphere, from a 64-bit Mersenne twister
/// and own arithmetic, so a seed gives the same points with every compiler. Throws
/// Error(InvalidInput) if count < 1.
std::vector<Vector3> random_directions(int count, std::uint64_t seed);

/// Moves the Fibonacci lattice so that its density follows `density` (> 0, any scale), by the
/// marginal distribution in z and the conditional distribution in azimuth, tabulated on `rows`
/// latitude bands. Calls `density` once, for the middles of rows x 2 rows cells; it returns one
/// value per cell. Throws Error(InvalidInput) if count < 1, rows < 2 or a value is not positive and
/// finite.
using DensityFunction = std::function<std::vector<double>(const std::vector<Vector3>& directions)>;
std::vector<Vector3> warped_lattice(int count, const DensityFunction& density, int rows);

/// Returns the equal-angle grid: two poles and `rings` parallels of 2 * (rings + 1) points at equal
/// angles (the paper's figure 1). The number of points is 2 + 2 rings (rings + 1). Throws
/// Error(InvalidInput) if rings < 1.
std::vector<Vector3> equal_angle_grid(int rings);

/// Returns the `equal_angle_grid` whose number of points is nearest to `count` (the smaller number
/// in a tie, and at least 6). Throws nothing of its own.
std::vector<Vector3> nearest_equal_angle_grid(int count);

/// Returns an icosahedron with every edge cut into `frequency` parts and its vertices projected to
/// the sphere: 10 frequency^2 + 2 points. Throws Error(InvalidInput) if frequency < 1.
std::vector<Vector3> subdivided_icosahedron(int frequency);

/// Returns the `subdivided_icosahedron` whose number of points is nearest to `count` (the smaller
/// number in a tie, and at least 12). Throws nothing of its own.
std::vector<Vector3> nearest_subdivided_icosahedron(int count);

}  // namespace wscvt
