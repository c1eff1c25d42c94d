// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "wscvt/base/counting_sort.h"
#include "wscvt/sphere/cube_map.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// A closed triangle mesh seen from the origin: r(u) is the distance to the outermost point that
/// the ray along u hits. Triangles are binned by direction, so a ray tests only a few. Gradient and
/// Hessian are derivatives of the radius of the hit plane, d / (n . u).
class MeshSurface : public RadialSurface {
 public:
  /// Stores a copy of the closed, outward mesh, moved by -centre and scaled by 1/unit.
  /// `overhang_fraction`: the mesh's overhang_solid_angle about the centre. Throws
  /// Error(InvalidInput) if the mesh is empty, the unit is not positive, or the centre lies on the
  /// mesh or outside.
  MeshSurface(const IndexedMesh& mesh, const Vector3& centre, double unit, double overhang_fraction,
              const Execution& execution);

  const IndexedMesh& mesh() const { return mesh_; }

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override;
  void evaluate_radii(const Vector3* directions, std::size_t count, double* radii) const override;

  /// Outermost intersection along one ray: the triangle's index and the distance.
  struct Hit {
    std::int32_t triangle = -1;
    double radius = 0.0;
  };

  /// Returns the outermost hit. Rays through an edge or a vertex are not missed: the test of Woop,
  /// Benthin and Wald (J. Comput. Graph. Tech. 2 (2013) 65-82). If triangles are hit at equal
  /// distances, the first counts. Throws Error(NumericalFailure) if nothing is hit. This cannot
  /// happen for a closed mesh about the origin.
  Hit outermost_hit(const Vector3& direction) const;

 private:
  IndexedMesh mesh_;
  bool star_shaped_ = false;  ///< every ray from the origin hits one point
  CubeMap cube_;
  Groups bins_;  ///< the triangles that may be seen in each cell
};

}  // namespace wscvt
