// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "toolbox/exchange/simulation_options.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Signed distances to a closed surface at the points of a grid along the axes: a level set.
struct DistanceGrid {
  Vector3 origin = Vector3::Zero();        ///< its first point
  double spacing = 0.0;                    ///< along each axis; length
  std::array<std::size_t, 3> counts = {};  ///< of points along x, y and z
  /// Negative inside; length. The point at origin + spacing (i, j, k) is number
  /// (i counts[1] + j) counts[2] + k.
  std::vector<double> values;
};

/// Largest number of points of a grid: 160 MB of distances, which take minutes.
inline constexpr double most_grid_points = 2e7;

/// Returns the spacing of a grid about the mesh: the options' value, or its default. Throws
/// Error(InvalidInput) for a mesh without faces or volume.
double grid_spacing(const IndexedMesh& closed, const GridOptions& options,
                    const Execution& execution);

/// Throws Error(InvalidInput), naming the option, if the spacing needs more than most_grid_points
/// about the mesh. Spacing 0 never throws.
void check_grid(const IndexedMesh& closed, const GridOptions& options);

/// Computes exact distances at the points of a grid (see MeshDistance). The sign is also exact:
/// from the crossings of a ray or, if the surface is too far to lie between, from a neighbouring
/// point. The grid starts at a multiple of the spacing, so that grids of one body are aligned.
///
/// Throws Error(InvalidInput) for a mesh without faces or volume, for options out of range and for
/// grids of more than 1.1 most_grid_points, Error(Cancelled).
DistanceGrid distance_grid(const IndexedMesh& closed, const GridOptions& options,
                           const Execution& execution);

/// Returns the bytes of a NumPy file (.npy, version 1.0): doubles, little-endian, [x][y][z] in C
/// order.
std::string grid_npy(const DistanceGrid& grid);

/// Returns the bytes of VTK's XML ImageData (.vti), for ParaView: the array "distance", appended
/// raw.
std::string grid_vti(const DistanceGrid& grid);

/// Returns a level set for NetDEM, in the format of a published example (apaam/examples,
/// netdem/data/ls_shape.json): corner, spacing, dim and signed_distance_table[x][y][z], positive
/// inside. Not tested: NetDEM is not available.
std::string grid_netdem(const DistanceGrid& grid);

}  // namespace wscvt
