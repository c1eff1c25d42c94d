// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the triangles of the points' convex hull, counter-clockwise seen from outside, as
/// indices into `points` (CGAL::convex_hull_3, exact predicates). Each triangle begins with its
/// smallest index; triangles are in ascending order. If several points are equal, the hull contains
/// one of them. Empty if all points lie in one plane. Uses one thread. Throws Error(Cancelled).
std::vector<Triangle> convex_hull_triangles(const std::vector<Vector3>& points,
                                            const Execution& execution = Execution(1));

/// Returns the convex hull as a closed outward mesh. Its points are the hull's corners, in the
/// order of the input. Throws Error(InvalidInput) if all points lie in one plane, and
/// Error(Cancelled).
IndexedMesh convex_hull(const std::vector<Vector3>& points,
                        const Execution& execution = Execution(1));

using Vector2 = Eigen::Vector2d;

/// Returns the corners of the convex hull of points in a plane, counter-clockwise (Andrew 1979,
/// "Another efficient algorithm for convex hulls in two dimensions", Inf. Process. Lett. 9,
/// 216-219). Leaves out points on its sides, up to rounding. Sorts `points` and removes inner
/// points. CGAL's convex_hull_2 finds the same corners in 1.5 to 1.8 times the time, and
/// descriptors need thousands of hulls.
std::vector<Vector2> planar_hull(std::vector<Vector2>& points);

/// planar_hull for few points, or if most points are near the hull: removes no points.
std::vector<Vector2> planar_hull_of_few(std::vector<Vector2>& points);

/// A rectangle about points in a plane.
struct Rectangle {
  Vector2 side = Vector2::UnitX();  ///< unit vector along `length`
  double length = 0.0;
  double width = 0.0;
  double area() const { return length * width; }
};

/// Returns the rectangle of least area about a convex polygon (Freeman and Shapira 1975, Commun.
/// ACM 18, 409-413: one of its sides lies on a side of the polygon). The area is 0 for fewer than
/// three corners.
Rectangle smallest_rectangle(const std::vector<Vector2>& hull);

/// The largest distance between two corners of a convex polygon, and the corners.
struct FarthestPair {
  Vector2 from = Vector2::Zero();
  Vector2 to = Vector2::Zero();
  double distance = 0.0;
};
FarthestPair farthest_pair(const std::vector<Vector2>& hull);

}  // namespace wscvt
