// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Six times the signed volume of the tetrahedron that the triangle a, b, c spans with the origin:
/// positive when the triangle runs counter-clockwise seen from the side away from the origin. Its
/// sign is subject to rounding: where that matters, see the exact predicates of
/// sphere_triangulation.cpp.
inline double six_volumes(const Vector3& a, const Vector3& b, const Vector3& c) {
  return a.dot(b.cross(c));
}

/// The normal of the triangle a, b, c on the side from which it runs counter-clockwise; as long as
/// twice its area.
inline Vector3 doubled_area_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
  return (b - a).cross(c - a);
}

/// Area of the triangle a, b, c.
inline double triangle_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  return 0.5 * doubled_area_normal(a, b, c).norm();
}

/// Weights >= 0 of the corners, sum 1, for the point of the triangle a, b, c nearest to `p`
/// (Ericson 2005, "Real-time collision detection", section 5.1.5).
Vector3 nearest_weights(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p);

/// Cosine of the smallest angle of the triangle a, b, c, the largest of the three; 1 where two
/// corners are one.
double largest_corner_cosine(const Vector3& a, const Vector3& b, const Vector3& c);

/// What adds up over the triangles of a closed, outward mesh to its volume, area and volume
/// centroid, by the tetrahedra that they span with the origin (Lien and Kajiya 1984, IEEE Comput.
/// Graph. Appl. 4 (10), 35-42).
struct MeshSums {
  double six_volumes = 0.0;
  double doubled_area = 0.0;
  Vector3 moment = Vector3::Zero();  ///< 24 times the integral of x over the volume
  std::size_t flat_triangles = 0;    ///< of no area

  void add(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double tetrahedron = wscvt::six_volumes(a, b, c);
    const double area = doubled_area_normal(a, b, c).norm();
    six_volumes += tetrahedron;
    doubled_area += area;
    moment += tetrahedron * (a + b + c);
    if (area == 0.0) ++flat_triangles;
  }

  MeshSums& operator+=(const MeshSums& other) {
    six_volumes += other.six_volumes;
    doubled_area += other.doubled_area;
    moment += other.moment;
    flat_triangles += other.flat_triangles;
    return *this;
  }

  double volume() const { return six_volumes / 6.0; }
  double area() const { return doubled_area / 2.0; }
  /// Relative to the origin of what was added; not finite without a volume.
  Vector3 centroid() const { return moment / (4.0 * six_volumes); }
};

/// The sums about `origin`: one near the mesh keeps the digits of a mesh far away. The same bits on
/// any number of threads.
MeshSums mesh_sums(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                   const Vector3& origin, const Execution& execution);

/// The volume that a closed mesh encloses, length^3: negative if it is inward. Summed about a
/// corner of the first triangle, of which there must be one. The same bits on any number of
/// threads.
double volume_of(const IndexedMesh& mesh, const Execution& execution);

/// Unit normals at the points, outward for an outward mesh: the mean of those of the triangles
/// about, by area. Zero where no triangle with an area is.
std::vector<Vector3> vertex_normals(const std::vector<Vector3>& points,
                                    const std::vector<Triangle>& triangles);

/// A third of the area of its triangles for each vertex; they add up to the mesh's area.
std::vector<double> vertex_areas(const IndexedMesh& mesh);

}  // namespace wscvt
