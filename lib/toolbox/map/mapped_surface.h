// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/cube_map.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

/// A scan with a one-to-one spherical parametrization (sphere_map.h): every direction u has one
/// place on the mesh, x(u). Let a face have corners at the directions a, b, c. Its weights are
/// alpha, beta, gamma of u = alpha a + beta b + gamma c, scaled to sum 1, so arcs of great circles
/// within a face map to straight lines.
class MappedSurface {
 public:
  /// Stores the mesh and the directions of its vertices. Throws Error(InvalidInput) unless each
  /// vertex has a unit vector, the mesh is closed, and all triangles are counter-clockwise on the
  /// sphere and cover it once.
  MappedSurface(IndexedMesh mesh, std::vector<Vector3> directions, const Execution& execution);

  const IndexedMesh& mesh() const { return mesh_; }
  const std::vector<Vector3>& directions() const { return directions_; }

  /// Returns the place in a direction (of any length except zero), by a walk over the sphere's
  /// triangles from one that a table gives. Exact predicates guarantee that the triangle contains
  /// the direction, for any shape. Thread-safe.
  MeshPlace locate(const Vector3& direction) const;

  /// Returns the point of the surface in length units of the mesh: of a place, or x(u).
  Vector3 position(const MeshPlace& place) const { return combination(mesh_.points, place); }
  std::vector<Vector3> positions(const std::vector<Vector3>& directions,
                                 const Execution& execution) const;

  /// Returns the direction of a place: the inverse of locate.
  Vector3 direction(const MeshPlace& place) const {
    return combination(directions_, place).normalized();
  }

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

/// Fits x, y and z over the mapped scan by least squares, weighted by the scan's area: one matrix
/// with three right-hand sides. Quadrature over the faces uses points closer than half a radian /
/// degree, so the result depends on the surface and its map, not on its triangulation.
///
/// The degree is lowered until there are at least two points per coefficient and the condition is
/// at most 1000. Throws Error(InvalidInput) if the degree is not in [0, 60] or the surface has no
/// area, and Error(NumericalFailure) if even degree 0 has no solution.
HarmonicMap fit_harmonic_map(const MappedSurface& surface, int degree, const Execution& execution);

}  // namespace wscvt
