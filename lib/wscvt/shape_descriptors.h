// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/execution.h"
#include "wscvt/mesh.h"

namespace wscvt {

/// Shape descriptors of a closed, outward mesh.
struct ShapeDescriptors {
  double volume = 0.0;        ///< length^3
  double area = 0.0;          ///< length^2
  double aspect_ratio = 0.0;  ///< S/L of the inertia-equivalent ellipsoid, in (0, 1]
  double sphericity = 0.0;    ///< Wadell: (36 pi V^2)^(1/3) / A, in (0, 1]
  double sdq = 0.0;           ///< invariant root-mean-square gradient, see the .cpp; no unit
  Vector3 centroid = Vector3::Zero();  ///< of the volume
  /// Semi-axes of the homogeneous ellipsoid with the same volume moments, S <= I <= L; length.
  Vector3 inertia_semi_axes = Vector3::Zero();
};

/// Measures a closed outward mesh. Sdq is taken about the volume centroid. Throws
/// Error(InvalidInput) when the volume is not positive.
ShapeDescriptors describe_shape(const IndexedMesh& mesh, const Execution& execution);

/// 100 (value / reference - 1).
double relative_error_percent(double value, double reference);

}  // namespace wscvt
