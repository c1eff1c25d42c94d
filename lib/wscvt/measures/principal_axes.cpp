// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t axes_block = 8192;

/// Below this skewness along an axis, a body counts as symmetric there. Rounding errors are
/// smaller.
constexpr double smallest_skewness = 1e-9;

/// The volume, and the third moments along two axes, so that the mesh is read once.
struct AxisMoments {
  double volume = 0.0;
  Eigen::Vector2d third = Eigen::Vector2d::Zero();

  AxisMoments& operator+=(const AxisMoments& other) {
    volume += other.volume;
    third += other.third;
    return *this;
  }
};

/// Sums over the tetrahedra of the faces and the centroid. A coordinate is linear in each
/// tetrahedron, with the values 0, a, b and c at its corners. The mean of its cube is then 1/20 of
/// the sum of all products of three of the values, aaa + aab + ... + ccc.
AxisMoments moments_along(const Eigen::Matrix<double, 3, 2>& axes, const IndexedMesh& mesh,
                          const Vector3& centroid, const Execution& execution) {
  return execution.parallel_sum(
      mesh.triangles.size(), axes_block, AxisMoments(), [&](std::size_t begin, std::size_t end) {
        AxisMoments part;
        for (std::size_t f = begin; f < end; ++f) {
          const Triangle& t = mesh.triangles[f];
          const Vector3 corner_a = mesh.points[t[0]] - centroid;
          const Vector3 corner_b = mesh.points[t[1]] - centroid;
          const Vector3 corner_c = mesh.points[t[2]] - centroid;
          const Eigen::Array2d a = axes.transpose() * corner_a;
          const Eigen::Array2d b = axes.transpose() * corner_b;
          const Eigen::Array2d c = axes.transpose() * corner_c;
          const double volume = six_volumes(corner_a, corner_b, corner_c) / 6.0;
          const Eigen::Array2d products = (a * a + b * b + c * c) * (a + b + c) + a * b * c;
          part.volume += volume;
          part.third += (volume / 20.0 * products).matrix();
        }
        return part;
      });
}

/// Returns the axis or its opposite. `skewness` (no unit) is the third moment of the body's points
/// along the axis over the cube of their spread.
Vector3 with_sign(const Vector3& axis, double skewness) {
  if (std::abs(skewness) > smallest_skewness) return skewness > 0.0 ? axis : Vector3(-axis);
  Eigen::Index largest = 0;
  // Components that differ only by rounding count as equal.
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
  const Vector3& moments_of_inertia = solver.eigenvalues();
  const AxisMoments moments =
      moments_along(solver.eigenvectors().leftCols<2>(), mesh, centroid, execution);
  Eigen::Matrix3d axes;
  for (int k = 0; k < 2; ++k) {
    // The second moment along an axis follows from the moments of inertia: integral of x_k^2 dV =
    // (I_1 + I_2 + I_3) / 2 - I_k.
    const double second = 0.5 * moments_of_inertia.sum() - moments_of_inertia[k];
    const double skewness =
        moments.third[k] * std::sqrt(moments.volume) / portable::pow(second, 1.5);
    axes.col(k) = with_sign(solver.eigenvectors().col(k), skewness);
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  Eigen::Quaterniond turn(axes);
  turn.normalize();
  if (turn.w() < 0.0) turn.coeffs() *= -1.0;
  return turn;
}

}  // namespace wscvt
