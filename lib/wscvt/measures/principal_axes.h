// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the unit quaternion q that turns the principal axes into the mesh's axes: a point p of
/// the principal frame is centroid + q p in the mesh's frame. Programs choose differently among the
/// 24 possible frames. Here the body determines the frame:
/// - Order: moments ascend, so x is along the longest axis and z along the shortest.
/// - Sign: x and y point to where the body reaches farther, by the third moment of its volume along
///   them, integral of x^3 dV >= 0, so the frame does not depend on the pose. If the body is
///   symmetric along an axis, the axis's largest component in the mesh's frame (the first of
///   several) is positive, which depends on the pose. z completes a right-handed frame.
/// - q has w >= 0.
/// If moments are equal, as for a sphere or a cube, the axes are arbitrary.
///
/// `centroid` and `inertia_tensor` as in this mesh's ShapeDescriptors.
Eigen::Quaterniond principal_axes(const IndexedMesh& mesh, const Vector3& centroid,
                                  const Eigen::Matrix3d& inertia_tensor,
                                  const Execution& execution);

}  // namespace wscvt
