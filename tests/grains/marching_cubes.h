// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "marching_cubes.h"
#include "wscvt/base/mesh.h"

namespace wscvt::test {

/// Values on the nodes of a regular grid, x running fastest.
struct VoxelGrid {
  std::array<int, 3> size{};
  Vector3 origin = Vector3::Zero();  ///< position of node (0, 0, 0)
  double spacing = 1.0;
  std::vector<double> values;

  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(z));
  }
};

/// Surface around all values above `level`, facing the lower ones; a closed 2-manifold whenever the
/// values on the border of the grid are below the level. One vertex on every grid edge it crosses
/// and one in the middle of the rare cell that cannot be triangulated without.
///
/// The 256 cases are derived, not listed: on each face of a cell the crossed edges are joined by
/// one rule (high corners that are diagonal neighbours stay apart) that both cells sharing it
/// apply, the segments close to loops, and a loop is cut into triangles by diagonals that lie in no
/// face.
IndexedMesh marching_cubes(const VoxelGrid& grid, double level);

/// Gaussian of the given standard deviation, in nodes, along every axis; the border is continued.
void blur(VoxelGrid& grid, double deviation);

}  // namespace wscvt::test
