// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns six times the signed volume of the tetrahedron of the triangle a, b, c and the origin.
/// It is positive if the triangle is counter-clockwise seen from the side away from the origin.
/// Rounding may change the sign: if that matters, use the exact predicates of
/// sphere_triangulation.h.
inline double six_volumes(const Vector3& a, const Vector3& b, const Vector3& c) {
  return a.dot(b.cross(c));
}

/// Returns the normal of the triangle a, b, c on the side from which it is counter-clockwise. Its
/// length is twice the area.
inline Vector3 doubled_area_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
  return (b - a).cross(c - a);
}

/// Area of the triangle a, b, c.
inline double triangle_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  return 0.5 * doubled_area_normal(a, b, c).norm();
}

/// Returns the corners of triangle `t` of a mesh.
template <class Mesh>
std::array<Vector3, 3> corners_of(const Mesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

/// Returns doubled_area_normal of triangle `t` of a mesh.
template <class Mesh>
Vector3 doubled_area_normal(const Mesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return doubled_area_normal(mesh.points[a], mesh.points[b], mesh.points[c]);
}

/// Returns the corners of a triangle of a mesh.
inline std::array<Vector3, 3> corners_of(const IndexedMesh& mesh, const Triangle& t) {
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

/// Area of a triangle of a mesh.
inline double triangle_area(const IndexedMesh& mesh, const Triangle& t) {
  return triangle_area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
}

/// Returns the smallest box of a triangle, with sides along the axes.
inline Eigen::AlignedBox3d box_of(const std::array<Vector3, 3>& corners) {
  return {corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]),
          corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])};
}

/// Returns the smallest box of points, with sides along the axes. Empty without points.
Eigen::AlignedBox3d box_of(const std::vector<Vector3>& points);

/// Returns the smallest box of the corners of the faces; other points may lie anywhere.
Eigen::AlignedBox3d box_of_faces(const IndexedMesh& mesh);

/// Returns the barycentric weights of the point of the triangle a, b, c nearest to `p`: each >= 0,
/// sum 1 (Ericson 2005, "Real-time collision detection", section 5.1.5).
Vector3 nearest_weights(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p);

/// Returns the cosine of the smallest angle of the triangle a, b, c; 1 if two corners are equal.
double largest_corner_cosine(const Vector3& a, const Vector3& b, const Vector3& c);

/// Sums over the triangles of a closed, outward mesh that give its volume, area and volume
/// centroid, from the tetrahedra of the triangles and the origin (Lien and Kajiya 1984, IEEE
/// Comput. Graph. Appl. 4 (10), 35-42).
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
  /// Relative to the origin of the sums; not finite if the volume is 0.
  Vector3 centroid() const { return moment / (4.0 * six_volumes); }
};

/// Computes the sums about `origin`. An origin near the mesh keeps the digits if the mesh is far
/// from 0. The bits do not depend on the number of threads.
MeshSums mesh_sums(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                   const Vector3& origin, const Execution& execution);

/// Returns the volume of a closed mesh, length^3; negative if it is inward. Sums about a corner of
/// the first triangle, which must exist. The bits do not depend on the number of threads.
double volume_of(const IndexedMesh& mesh, const Execution& execution);

/// Returns unit normals at the points, outward for an outward mesh: the area-weighted mean of the
/// normals of the triangles at the point. Zero if no triangle there has an area.
std::vector<Vector3> vertex_normals(const std::vector<Vector3>& points,
                                    const std::vector<Triangle>& triangles);

/// Returns a third of the area of its triangles for each vertex. The sum is the mesh's area.
std::vector<double> vertex_areas(const IndexedMesh& mesh);

/// Steps above this fraction of the mean edge are coarse. Rounding moves corners by up to half a
/// step, which turns the edges of a face by about a degree.
inline constexpr double coarse_step = 0.03;

/// Returns the mean edge length over faces spread evenly over the list, enough for two digits;
/// length. 0 without faces. All corners are valid.
double sampled_mean_edge(const IndexedMesh& mesh);

/// Returns the step of single precision at the largest coordinate of a corner, as a fraction of the
/// mean edge. 0 if this is not above 0 and finite. All corners are valid.
double single_precision_step(const IndexedMesh& mesh);

/// Moves all points of a closed, outward mesh along their normals by one distance, so that it
/// encloses `volume` > 0 to rounding. Returns the distance, > 0 outwards; length. If the mesh is
/// far from this volume, scales it about its centroid and returns the mean distance. Leaves a mesh
/// whose own volume is not positive unchanged.
double offset_to_volume(std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                        double volume);

/// A place on a triangle mesh: a triangle and barycentric weights >= 0 of its corners, sum 1.
struct MeshPlace {
  std::int32_t triangle = -1;
  Vector3 weights = Vector3::Zero();
};

/// Returns the point of a mesh at a place.
inline Vector3 point_at(const IndexedMesh& mesh, const MeshPlace& place) {
  // Starts from a corner, so that only small differences are multiplied if the mesh is far from the
  // origin.
  const auto& [a, b, c] = mesh.triangles[place.triangle];
  const Vector3& p = mesh.points[a];
  return p + place.weights[1] * (mesh.points[b] - p) + place.weights[2] * (mesh.points[c] - p);
}

}  // namespace wscvt
