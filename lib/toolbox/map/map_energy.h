// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The data of a surface triangle for the energy of its image on the sphere.
struct ReferenceTriangle {
  std::array<double, 3> cotangents{};  ///< of the angles at the corners
  double area = 0.0;
};

/// Returns the reference triangle a, b, c. If it is flatter than a thousandth, all its edges are
/// lengthened by the amount missing in the triangle inequality (Sharp and Crane 2020, "A Laplacian
/// for nonmanifold triangle meshes", section 4.5), so the cotangents stay within about 1000.
ReferenceTriangle reference_triangle(const Vector3& a, const Vector3& b, const Vector3& c);

/// Symmetric Dirichlet energy of the triangles about one vertex, as a function of its position on
/// the sphere (Smith and Schaefer 2015, "Bijective parameterization with free boundaries", eq. 6):
/// the sum of D (1 + A_ref^2 / A^2) with D = (1/2) sum of cot l^2 and A = det(p, q, r) / 2. As A
/// approaches zero the energy approaches infinity, so a descent turns no triangle over.
class VertexFan {
 public:
  void clear() { triangles_.clear(); }

  /// Adds the triangle (vertex, q, r) with the cotangents at the vertex, at q and at r.
  /// `area_square`: of the reference triangle, in the sphere's unit.
  void add(const Vector3& q, const Vector3& r, double cotangent, double cotangent_q,
           double cotangent_r, double area_square);

  /// Makes one Newton step on the sphere from the unit vector p, with a positive Hessian and a line
  /// search. All triangles stay counter-clockwise. Returns the squared displacement of p / the mean
  /// square of its edges; 0 if no step lowers the energy.
  double improve(Vector3& p) const;

  /// Returns the energy at p; infinite unless all triangles are certainly counter-clockwise.
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
