// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sample/sample_grain.h"

namespace wscvt {

/// Makes meshes of grains that are given by SH series: nodes in the directions of a Fibonacci
/// lattice, spread along the grain's axes.
class GrownMeshes {
 public:
  /// Throws Error(InvalidInput) for fewer than 4 nodes, Error(NumericalFailure) where so few lie in
  /// one half of the sphere.
  GrownMeshes(int nodes, const Execution& execution);

  /// A closed, outward mesh of exactly the nodes, in the principal frame about the origin, of
  /// exactly the volume of the sphere of `radius`; length. The triangles are intrinsic Delaunay on
  /// it. May be called from several threads.
  IndexedMesh mesh(const std::vector<double>& radial, double radius) const;

 private:
  std::vector<Vector3> directions_;
  std::vector<Triangle> triangles_;
};

/// Descriptors that grown grains are compared with real ones by; none has a unit.
struct GrownShape {
  double sphericity = 0.0;  ///< Wadell's
  double elongation = 0.0;  ///< I/L of the inertia ellipsoid
  double flatness = 0.0;    ///< S/I of the inertia ellipsoid
  double convexity = 0.0;   ///< volume over that of the convex hull
};

/// Throws as describe_shape.
GrownShape grown_shape(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
