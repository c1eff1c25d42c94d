// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A convex body: the hull of points, with the planes of its faces.
struct ConvexBody {
  IndexedMesh hull;                     ///< closed, outward
  std::vector<Eigen::Vector4d> planes;  ///< unit outward normals, and the offset along them
  double volume = 0.0;                  ///< length^3

  bool empty() const { return planes.empty(); }

  /// Returns the largest distance of a point beyond a face; length. Inside it is negative, and its
  /// absolute value is the distance to the boundary. Outside, the distance to the body is at least
  /// this large.
  double excess(const Vector3& point) const;
};

/// Returns the hull of points. Empty if they lie in a plane.
ConvexBody convex_body(const std::vector<Vector3>& points);

/// Returns the body with at most `faces` triangles, 4 or more: the hull of some of its points. They
/// are chosen one by one, each the point farthest outside the hull of the previous ones. Returns
/// the body itself if it has no more faces.
ConvexBody with_fewer_faces(const ConvexBody& body, int faces);

}  // namespace wscvt
