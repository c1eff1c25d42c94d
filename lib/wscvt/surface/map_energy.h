// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// What a triangle of the surface contributes to the energy of its image on the sphere.
struct ReferenceTriangle {
  std::array<double, 3> cotangents{};  ///< of the angles at the corners
  double area = 0.0;
};

/// The reference triangle a, b, c. One flatter than a thousandth is taken for slightly larger: all
/// its edges are made longer by what the triangle inequality lacks (Sharp and Crane 2020, "A
/// Laplacian for nonmanifold triangle meshes", section 4.5), so the cotangents stay within
/// about 1000.
ReferenceTriangle reference_triangle(const Vector3& a, const Vector3& b, const Vector3& c);

/// Symmetric Dirichlet energy of the triangles about one vertex, as a function of its place on the
/// sphere (Smith and Schaefer 2015, "Bijective parameterization with free boundaries", eq. 6): the
/// sum of D (1 + A_ref^2 / A^2) with D = (1/2) sum of cot l^2 and A = det(p, q, r) / 2. As A goes
/// to zero the energy goes to infinity, so a descent turns no triangle over.
class VertexFan {
 public:
  void clear() { triangles_.clear(); }

  /// Adds the triangle (vertex, q, r); `cotangents` at the vertex, at q and at r, `area_square` of
  /// the reference in the sphere's unit.
  void add(const Vector3& q, const Vector3& r, double cotangent, double cotangent_q,
           double cotangent_r, double area_square);

  /// One Newton step on the sphere from the unit vector p, with the Hessian made positive and a
  /// line search; all triangles stay counter-clockwise. Returns the square of the way p went over
  /// the mean square of its edges; 0 where the energy could not be lowered.
  double improve(Vector3& p) const;

  /// The energy at p; infinite where a triangle is not counter-clockwise with certainty.
  double energy(const Vector3& p) const;

 private:
  struct FanTriangle {
    Vector3 q, r;
    Vector3 normal;  ///< q x r
    double cotangent_q, cotangent_r;
    double opposite_edge;  ///< cotangent at the vertex * |q - r|^2
    double area_square;
    double certain;  ///< A^2 above this times |p - q|^2 is positive beyond rounding
  };
  std::vector<FanTriangle> triangles_;
};

}  // namespace wscvt
