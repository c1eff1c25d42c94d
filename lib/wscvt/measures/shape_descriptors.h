// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Shape descriptors of a closed, outward mesh that follow from integrals over it: cheap enough for
/// every remesh. See detailed_descriptors.h for the others.
///
/// Integrals over the volume are turned into sums over the faces by the divergence theorem: each
/// face spans a signed tetrahedron with a point near the middle of the mesh (Lien and Kajiya 1984,
/// IEEE Comput. Graph. Appl. 4 (10), 35-42; Mirtich 1996, "Fast and accurate computation of
/// polyhedral mass properties", J. Graph. Tools 1 (2), 31-50). They are exact for the polyhedron.
struct ShapeDescriptors {
  /// (1/6) sum a . (b x c) over the faces, a, b, c their corners (Lien and Kajiya; Mirtich);
  /// length^3.
  double volume = 0.0;
  double area = 0.0;  ///< (1/2) sum |(b - a) x (c - a)| over the faces; length^2
  /// S/L of the inertia ellipsoid, in (0, 1]; no unit. Source as of inertia_semi_axes.
  double aspect_ratio = 0.0;
  /// (36 pi V^2)^(1/3) / A, in (0, 1]; no unit (Wadell 1932, "Volume, shape, and roundness of rock
  /// particles", J. Geol. 40, 443-451).
  double sphericity = 0.0;
  /// Root-mean-square gradient of the radius, in a form of this library that does not depend on the
  /// orientation. It takes the place of the paper's eq. 17, which does (see printed_sdq):
  /// Sdq^2 = (1/A) integral of |grad_Omega r|^2 dOmega = (1/A) sum A_f (1 - c_f^2) / c_f, with c_f
  /// the cosine between a face's normal and the direction of its centroid from the volume centroid.
  /// c_f is taken as at least 0.05, so that folds do not count as infinitely steep. No unit; 0 for
  /// a sphere.
  double sdq = 0.0;
  Vector3 centroid = Vector3::Zero();  ///< of the volume (Lien and Kajiya; Mirtich); length
  /// Semi-axes of the homogeneous ellipsoid with the same second moments of volume per volume (the
  /// inertia ellipsoid), S <= I <= L; length. a_k = (5 m_k)^(1/2) with m_k the eigenvalues of
  /// (1/V) integral of x x^T dV about the centroid: the ellipsoid of equal radii of gyration of
  /// Medalia (1971), "Dynamic shape factors of particles", Powder Technol. 4, 117-138.
  Vector3 inertia_semi_axes = Vector3::Zero();
  /// Tensor of inertia about the centroid at unit density (Lien and Kajiya; Mirtich); length^5.
  Eigen::Matrix3d inertia_tensor = Eigen::Matrix3d::Zero();
  /// Unit quaternion that turns the principal axes into the mesh's, as in MassProperties; no unit.
  Eigen::Quaterniond principal_axes = Eigen::Quaterniond::Identity();
};

/// Measures a closed outward mesh, as accurately far from the origin as near it. Throws
/// Error(InvalidInput) when the volume is not positive.
ShapeDescriptors describe_shape(const IndexedMesh& mesh, const Execution& execution);

/// 100 (value / reference - 1); 0 when the two are equal, even at zero.
double relative_error_percent(double value, double reference);

/// Largest absolute entry of the difference of two inertia tensors, in the principal axes of the
/// reference, in % of the reference's largest principal moment: a measure of this library.
double inertia_error_percent(const ShapeDescriptors& value, const ShapeDescriptors& reference);

/// Descriptors measured in lengths of `unit` about `centre`, in plain lengths.
void scale(ShapeDescriptors& descriptors, double unit, const Vector3& centre);

}  // namespace wscvt
