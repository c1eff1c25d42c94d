// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A convex body: the hull of points, with the planes of its faces.
struct ConvexBody {
  IndexedMesh hull;                     ///< closed, outward
  std::vector<Eigen::Vector4d> planes;  ///< unit normals outward, and the offset along them
  double volume = 0.0;                  ///< length^3

  bool empty() const { return planes.empty(); }

  /// How far a point lies beyond the face that it lies farthest beyond; length. Negative inside,
  /// where it is the distance to the boundary; outside the distance is at least that.
  double excess(const Vector3& point) const;
};

/// The hull of points. Empty if they lie in a plane.
ConvexBody convex_body(const std::vector<Vector3>& points);

/// The body with at most `faces` triangles, 4 or more: the hull of so many of its points, chosen
/// one after the other, each the one farthest outside the hull of those before. The body itself if
/// it has no more faces.
ConvexBody with_fewer_faces(const ConvexBody& body, int faces);

}  // namespace wscvt
