// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/measures/shape_descriptors.h"

namespace wscvt {

/// What a simulation asks of a rigid body, at unit density: mass is volume times density, moments
/// are those here times density.
struct MassProperties {
  double volume = 0.0;                                       ///< length^3
  Vector3 centroid = Vector3::Zero();                        ///< length
  Eigen::Matrix3d inertia_tensor = Eigen::Matrix3d::Zero();  ///< about the centroid; length^5
  Vector3 principal_moments = Vector3::Zero();               ///< ascending; length^5
  /// Unit quaternion q: a point p of the principal frame is centroid + q p in the mesh's. x runs
  /// along the longest axis, z along the shortest; lib/README.md says how signs are chosen.
  Eigen::Quaterniond principal_axes = Eigen::Quaterniond::Identity();
};

/// Of a body whose descriptors are known. Throws nothing.
MassProperties mass_properties(const ShapeDescriptors& descriptors);

}  // namespace wscvt
