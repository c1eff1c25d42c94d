// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/cube_map.h"
#include "wscvt/surface/mesh_place.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// A scan spread over the unit sphere, one to one (sphere_map.h): every direction u has one place
/// on the mesh, x(u). Within the spherical triangle of a face with corners at the directions a, b,
/// c the weights are those of u = alpha a + beta b + gamma c scaled to sum 1, so x(u) runs straight
/// over the face and arcs of great circles within a face go to straight lines. Its derivatives jump
/// from face to face, and its curvature is zero within each: all of it lies in the edges.
class MappedSurface : public SphereSurface {
 public:
  /// Takes the mesh and the directions of its vertices. Throws Error(InvalidInput) unless there is
  /// a unit vector for each vertex, the mesh is closed, and all triangles are counter-clockwise on
  /// the sphere and cover it once.
  MappedSurface(IndexedMesh mesh, std::vector<Vector3> directions, const Execution& execution);

  const IndexedMesh& mesh() const { return mesh_; }
  const std::vector<Vector3>& directions() const { return directions_; }
  /// The half-edge that runs the other way, for each; numbered as in half_edges.h.
  const std::vector<std::int32_t>& opposite() const { return opposite_; }

  void evaluate_jets(const Vector3* directions, std::size_t count, Derivatives derivatives,
                     SurfaceJet* jets) const override;

  /// The place in a direction (any length but zero), by a walk over the sphere's triangles from the
  /// triangle `hint`, or from a table where `hint` is -1. Exact predicates, so the triangle holds
  /// the direction whatever its shape; on an edge or in a vertex it is one of those there, and may
  /// depend on the hint, while the position does not but for rounding. May be called from several
  /// threads.
  MeshPlace locate(const Vector3& direction, std::int32_t hint = -1) const;

  /// The point of the surface, x(u) in length units of the mesh.
  Vector3 position(const MeshPlace& place) const { return combination(mesh_.points, place); }
  Vector3 position(const Vector3& direction, std::int32_t hint = -1) const {
    return position(locate(direction, hint));
  }

  /// The direction of a place: locate's inverse.
  Vector3 direction(const MeshPlace& place) const {
    return combination(directions_, place).normalized();
  }

  /// Outward unit normal of the face; zero for a face without area.
  Vector3 normal(const MeshPlace& place) const;

 private:
  Vector3 combination(const std::vector<Vector3>& values, const MeshPlace& place) const {
    const Triangle& t = mesh_.triangles[place.triangle];
    return place.weights[0] * values[t[0]] + place.weights[1] * values[t[1]] +
           place.weights[2] * values[t[2]];
  }

  IndexedMesh mesh_;
  std::vector<Vector3> directions_;
  std::vector<std::int32_t> opposite_;
  CubeMap cube_;
  std::vector<std::int32_t> starts_;  ///< a triangle in or near each cell
};

}  // namespace wscvt
