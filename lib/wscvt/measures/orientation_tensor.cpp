// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/orientation_tensor.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

OrientationTensor orientation_tensor(const IndexedMesh& mesh, const Execution& execution) {
  constexpr std::size_t block_size = 8192;
  // The trace of the sum is the area.
  const Eigen::Matrix3d sum = execution.parallel_sum(
      mesh.triangles.size(), block_size, Eigen::Matrix3d(Eigen::Matrix3d::Zero()),
      [&](std::size_t begin, std::size_t end) {
        Eigen::Matrix3d part = Eigen::Matrix3d::Zero();
        for (std::size_t f = begin; f < end; ++f) {
          const Triangle& t = mesh.triangles[f];
          const Vector3 doubled_area =
              doubled_area_normal(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
          const double length = doubled_area.norm();
          if (length > 0.0) part += 0.5 / length * doubled_area * doubled_area.transpose();
        }
        return part;
      });
  if (!(sum.trace() > 0.0)) {
    throw Error(
        ErrorCode::InvalidInput,
        "The mesh has no area, so it has no surface orientation. Give a triangle mesh with area.");
  }
  OrientationTensor result;
  result.tensor = sum / sum.trace();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(result.tensor,
                                                              Eigen::EigenvaluesOnly);
  result.eigenvalues = solver.eigenvalues().reverse();
  const double largest = result.eigenvalues[0];
  result.compactness = result.eigenvalues[2] / largest;
  result.flakiness = (largest - result.eigenvalues[1]) / largest;
  result.rodness = (result.eigenvalues[1] - result.eigenvalues[2]) / largest;
  return result;
}

}  // namespace wscvt
