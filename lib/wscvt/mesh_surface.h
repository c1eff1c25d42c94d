// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/radial_surface.h"

namespace wscvt {

/// A closed triangle mesh seen from the origin: r(u) is the distance to the outermost point that
/// the ray along u meets. Triangles are binned by direction, so a ray tests only a few. The
/// gradient is that of the plane met, the Hessian of a plane's radius.
class MeshSurface : public RadialSurface {
 public:
  /// Keeps a copy of the mesh moved by -centre and scaled by 1/unit. Throws Error(InvalidInput)
  /// when the mesh is empty or the centre lies on it or outside.
  MeshSurface(const IndexedMesh& mesh, const Vector3& centre, double unit,
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
  Hit outermost_hit(const Vector3& direction) const;

 private:
  IndexedMesh mesh_;
};

}  // namespace wscvt
