// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns how far a patch bends over a rim, from 0 (a sheet) to 1 (both sheets). `flatness` is the
/// length of the sum of its area vectors over its area, 0 to 1.
///
/// A rim that is thinner than an edge needs one row of nodes. Coarsening leaves clusters that hold
/// both sheets on the rim. Equalization moves their nodes only along the rim. In the fit, rings
/// pull them only along it, and the samples of both sheets place them across it.
double rim_share(double flatness);

/// Returns the unit direction in which `tensor` is smallest.
Vector3 least_direction(const Eigen::Matrix3d& tensor);

/// Shape of the triangles about a node.
struct StarShape {
  Vector3 normal = Vector3::UnitZ();  ///< unit
  double rim = 0.0;                   ///< rim_share of the star
  Vector3 along = Vector3::Zero();    ///< the rim's direction, unit, if `rim` > 0

  /// Returns the part of a vector along the surface, and at a rim along the rim.
  Vector3 tangential(const Vector3& v) const {
    Vector3 flat = v - normal.dot(v) * normal;
    if (rim == 0.0) return flat;
    return (1.0 - rim) * flat + rim * along.dot(v) * along;
  }
};

/// Computes the shape of a star. `for_each` calls its argument with the area vector of every
/// triangle, in any unit, and its length. A rim's direction is the one to which their normals are
/// most perpendicular.
template <class ForEach>
StarShape star_shape(const ForEach& for_each) {
  Vector3 sum = Vector3::Zero();
  double area = 0.0;
  for_each([&](const Vector3& vector, double of_one) {
    sum += vector;
    area += of_one;
  });
  StarShape shape;
  const double length = sum.norm();
  if (length > 0.0) shape.normal = sum / length;
  shape.rim = rim_share(length / (area + 1e-300));
  if (shape.rim == 0.0) return shape;
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  for_each([&](const Vector3& vector, double of_one) {
    tensor += vector * vector.transpose() / (of_one + 1e-300);
  });
  shape.along = least_direction(tensor);
  return shape;
}

}  // namespace wscvt
