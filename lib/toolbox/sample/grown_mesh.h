// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toolbox/sample/grain_grower.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Makes meshes of grains given by SH series: nodes in the directions of a Fibonacci lattice,
/// spread along the grain's axes.
class GrownMeshes {
 public:
  /// Throws Error(InvalidInput) for fewer than 4 nodes, Error(NumericalFailure) if so few lie in
  /// one half of the sphere.
  GrownMeshes(int nodes, const Execution& execution);

  /// Returns a closed, outward mesh with exactly the number of nodes, in the frame of the series,
  /// with exactly the volume of the sphere of `radius`; length. The triangles are
  /// intrinsic Delaunay on it. With few nodes, a grain with an offset may intersect itself. May be
  /// called from several threads.
  IndexedMesh mesh(const std::vector<double>& radial, double radius,
                   const OffsetSeries& offset = {}) const;

 private:
  std::vector<Vector3> directions_;
  std::vector<Triangle> triangles_;
};

/// A virtual grain with its mesh, which is in its own principal frame about the origin.
struct GrownBody {
  GrownGrain grain;
  IndexedMesh mesh;
};

/// Returns grain number `index` of the grower: the first whose mesh does not intersect itself.
/// Throws as GrainGrower::grow.
GrownBody grow_body(const GrainGrower& grower, const GrownMeshes& meshes, std::size_t index);

}  // namespace wscvt
