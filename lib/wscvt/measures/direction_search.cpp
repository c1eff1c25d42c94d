// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/direction_search.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "wscvt/base/portable_math.h"
#include "wscvt/base/sorting.h"

namespace wscvt {

std::vector<Vector3> extreme_points(const std::vector<Vector3>& points, int directions,
                                    const char* stage, const Execution& execution) {
  if (points.size() <= static_cast<std::size_t>(directions)) return points;
  std::vector<std::size_t> extremes;
  for (const Vector3& direction : fibonacci_lattice(directions)) {
    execution.report(0.0, stage);
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
  sort_unique(extremes);
  std::vector<Vector3> result;
  result.reserve(extremes.size());
  for (const std::size_t i : extremes) result.push_back(points[i]);
  return result;
}

Range range_along(const std::vector<Vector3>& points, const Vector3& direction) {
  Range range = {direction.dot(points.front()), direction.dot(points.front())};
  for (const Vector3& p : points) {
    const double place = direction.dot(p);
    range.lowest = std::min(range.lowest, place);
    range.highest = std::max(range.highest, place);
  }
  return range;
}

Eigen::Matrix3d frame_of(const std::vector<Vector3>& points) {
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : points) mean += (p - points.front()) / static_cast<double>(points.size());
  mean += points.front();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const Vector3& p : points) second += (p - mean) * (p - mean).transpose();
  Eigen::Matrix3d frame = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second).eigenvectors();
  // The signs also turn with the body: axes point to where it reaches farther.
  for (int k = 0; k < 2; ++k) {
    double third = 0.0;
    for (const Vector3& p : points) third += portable::pow(frame.col(k).dot(p - mean), 3);
    if (third < 0.0) frame.col(k) = -frame.col(k);
  }
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

std::vector<Vector3> in_frame(const std::vector<Vector3>& points, const Vector3& origin,
                              const Eigen::Matrix3d& frame) {
  std::vector<Vector3> result;
  result.reserve(points.size());
  for (const Vector3& p : points) result.emplace_back(frame.transpose() * (p - origin));
  return result;
}

}  // namespace wscvt
