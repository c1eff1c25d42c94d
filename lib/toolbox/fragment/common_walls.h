// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A triangle of the wall between two bodies, or a body and the background.
struct WallTriangle {
  Triangle corners;    ///< counter-clockwise seen from `outer`
  std::int32_t inner;  ///< number of the body, the larger one
  std::int32_t outer;  ///< the smaller one; -1: background
};

/// Bodies as one complex of triangles: those that touch have the nodes and triangles of their wall
/// in common, walls that meet have their line in common.
struct WallComplex {
  std::vector<Vector3> points;
  std::vector<WallTriangle> triangles;  ///< each once
};

/// A wall between two bodies, which may be several patches.
struct CommonWall {
  std::int32_t first = 0;   ///< number of the body
  std::int32_t second = 0;  ///< larger
  std::size_t triangles = 0;
  double area = 0.0;                 ///< length^2
  Vector3 centre = Vector3::Zero();  ///< of the area
  Vector3 normal = Vector3::Zero();  ///< mean, from the first to the second; length 1
};

/// Returns the walls between bodies, by first, then second.
std::vector<CommonWall> common_walls(const WallComplex& complex);

/// Returns the closed mesh of each body. Its nodes and triangles are in the order of the complex,
/// so that two bodies have the same numbers, to the bit, on their wall.
std::vector<IndexedMesh> body_meshes(const WallComplex& complex, std::size_t bodies);

/// Returns the mean length of a closed mesh's edges.
double mean_edge_of(const IndexedMesh& mesh);

}  // namespace wscvt
