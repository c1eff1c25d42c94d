// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t block_size = 8192;

/// A body whose skewness along an axis is below this is symmetric there: rounding leaves less.
constexpr double smallest_skewness = 1e-9;

/// Second and third moments of volume along an axis.
struct AxisMoments {
  double second = 0.0;
  double third = 0.0;

  AxisMoments& operator+=(const AxisMoments& other) {
    second += other.second;
    third += other.third;
    return *this;
  }
};

/// Sums over the tetrahedra that the faces span with the centroid. A coordinate is linear in each,
/// with the values 0, a, b and c at its corners; the mean of its k-th power is then k! 3! / (k+3)!
/// times the sum of all products of k of the values.
AxisMoments moments_along(const Vector3& axis, const IndexedMesh& mesh, const Vector3& centroid,
                          const Execution& execution) {
  return execution.parallel_sum(
      mesh.triangles.size(), block_size, AxisMoments(), [&](std::size_t begin, std::size_t end) {
        AxisMoments part;
        for (std::size_t f = begin; f < end; ++f) {
          const Triangle& t = mesh.triangles[f];
          const Vector3 corner_a = mesh.points[t[0]] - centroid;
          const Vector3 corner_b = mesh.points[t[1]] - centroid;
          const Vector3 corner_c = mesh.points[t[2]] - centroid;
          const double a = axis.dot(corner_a);
          const double b = axis.dot(corner_b);
          const double c = axis.dot(corner_c);
          const double volume = six_volumes(corner_a, corner_b, corner_c) / 6.0;
          part.second += volume / 10.0 * (a * a + b * b + c * c + a * b + b * c + c * a);
          part.third +=
              volume / 20.0 *
              (a * a * (a + b + c) + b * b * (a + b + c) + c * c * (a + b + c) + a * b * c);
        }
        return part;
      });
}

Vector3 with_sign(const Vector3& axis, const IndexedMesh& mesh, const Vector3& centroid,
                  double volume_scale, const Execution& execution) {
  const AxisMoments moments = moments_along(axis, mesh, centroid, execution);
  // Without a unit: the third moment of the body's points over the cube of their spread.
  const double skewness = moments.third * std::sqrt(volume_scale) / std::pow(moments.second, 1.5);
  if (std::abs(skewness) > smallest_skewness) return skewness > 0.0 ? axis : Vector3(-axis);
  Eigen::Index largest = 0;
  // Components that differ by rounding alone count as equal.
  for (Eigen::Index k = 1; k < 3; ++k) {
    if (std::abs(axis[k]) > std::abs(axis[largest]) + smallest_skewness) largest = k;
  }
  return axis[largest] > 0.0 ? axis : Vector3(-axis);
}

}  // namespace

Eigen::Quaterniond principal_axes(const IndexedMesh& mesh, const Vector3& centroid,
                                  const Eigen::Matrix3d& inertia_tensor,
                                  const Execution& execution) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia_tensor);
  const double volume = mesh_sums(mesh.points, mesh.triangles, centroid, execution).volume();
  Eigen::Matrix3d axes;
  for (int k = 0; k < 2; ++k) {
    axes.col(k) = with_sign(solver.eigenvectors().col(k), mesh, centroid, volume, execution);
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  Eigen::Quaterniond turn(axes);
  turn.normalize();
  if (turn.w() < 0.0) turn.coeffs() *= -1.0;
  return turn;
}

}  // namespace wscvt
