// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The unit quaternion q that turns principal axes into those of the mesh: a point p of the
/// principal frame is centroid + q p in the mesh's. No two programs agree on which of the 24 such
/// frames to take, so here it is the body that says:
/// - Order: moments ascend, so x runs along the longest axis and z along the shortest.
/// - Sign: x and y point to where the body reaches farther, by the third moment of its volume along
///   them, integral of x^3 dV >= 0; so a body has one frame in whatever pose it lies. Along an axis
///   on which it is symmetric the largest component in the mesh's frame (the first of several) is
///   positive, which depends on the pose. z completes a right-handed frame.
/// - q has w >= 0.
/// Of equal moments, as a sphere's or a cube's, any axes may come.
///
/// `centroid` and `inertia_tensor` as ShapeDescriptors has them of this mesh.
Eigen::Quaterniond principal_axes(const IndexedMesh& mesh, const Vector3& centroid,
                                  const Eigen::Matrix3d& inertia_tensor,
                                  const Execution& execution);

}  // namespace wscvt
