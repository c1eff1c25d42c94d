// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/direction_search.h"

#include <Eigen/Eigenvalues>

namespace wscvt {

namespace {

constexpr int thinning_directions = 2000;

}  // namespace

std::vector<Vector3> extreme_points(const std::vector<Vector3>& points,
                                    const Eigen::Matrix3d& frame, const char* stage,
                                    const Execution& execution) {
  if (points.size() <= static_cast<std::size_t>(thinning_directions)) return points;
  std::vector<std::size_t> extremes;
  for (const Vector3& u : fibonacci_lattice(thinning_directions)) {
    execution.report(0.0, stage);
    const Vector3 direction = frame * u;
    std::size_t farthest = 0;
    double reach = direction.dot(points[0]);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double value = direction.dot(points[i]);
      if (value > reach) {
        reach = value;
        farthest = i;
      }
    }
    extremes.push_back(farthest);
  }
  std::sort(extremes.begin(), extremes.end());
  extremes.erase(std::unique(extremes.begin(), extremes.end()), extremes.end());
  std::vector<Vector3> result;
  result.reserve(extremes.size());
  for (const std::size_t i : extremes) result.push_back(points[i]);
  return result;
}

Eigen::Matrix3d frame_of(const std::vector<Vector3>& points) {
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : points) mean += (p - points.front()) / static_cast<double>(points.size());
  mean += points.front();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const Vector3& p : points) second += (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second).eigenvectors();
}

}  // namespace wscvt
