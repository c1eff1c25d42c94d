// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/execution.h"
#include "wscvt/indexed_mesh.h"

namespace wscvt {

/// Shape descriptors of a closed, outward mesh that follow from integrals over it: cheap enough for
/// every remesh. See detailed_descriptors.h for the others.
struct ShapeDescriptors {
  double volume = 0.0;        ///< length^3
  double area = 0.0;          ///< length^2
  double aspect_ratio = 0.0;  ///< S/L of the inertia-equivalent ellipsoid, in (0, 1]
  double sphericity = 0.0;    ///< Wadell (1932): (36 pi V^2)^(1/3) / A, in (0, 1]
  /// Root-mean-square gradient of the radius, in the form that does not depend on the orientation:
  /// Sdq^2 = (1/A) integral of |grad_Omega r|^2 dOmega = (1/A) sum A_f (1 - c_f^2) / c_f, with c_f
  /// the cosine between a face's normal and the direction of its centroid from the volume centroid.
  /// c_f is taken as at least 0.05, so that folds do not count as infinitely steep. No unit; 0 for
  /// a sphere.
  double sdq = 0.0;
  Vector3 centroid = Vector3::Zero();  ///< of the volume
  /// Semi-axes of the homogeneous ellipsoid with the same second moments of volume per volume (the
  /// inertia ellipsoid), S <= I <= L; length.
  Vector3 inertia_semi_axes = Vector3::Zero();
  /// Tensor of inertia about the centroid at unit density; length^5.
  Eigen::Matrix3d inertia_tensor = Eigen::Matrix3d::Zero();
};

/// Measures a closed outward mesh, as accurately far from the origin as near it. Throws
/// Error(InvalidInput) when the volume is not positive.
ShapeDescriptors describe_shape(const IndexedMesh& mesh, const Execution& execution);

/// 100 (value / reference - 1); 0 when the two are equal, even at zero.
double relative_error_percent(double value, double reference);

/// Largest absolute entry of the difference of two inertia tensors, in the principal axes of the
/// reference, in % of the reference's largest principal moment.
double inertia_error_percent(const ShapeDescriptors& value, const ShapeDescriptors& reference);

}  // namespace wscvt
