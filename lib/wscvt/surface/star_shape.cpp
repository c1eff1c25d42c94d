// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/star_shape.h"

#include <Eigen/Geometry>

#include "wscvt/base/numbers.h"

namespace wscvt {

namespace {

/// A rim begins below the first flatness and is complete at the second. The first at .85 leaves the
/// walls of thick plates to the rows of both sheets: rms of a washer, three edges thick, .26
/// instead of .18 % of its radius. The second at .5 changes nothing in the mean of 19 thin bodies.
constexpr double rim_begins = 0.95;
constexpr double rim_complete = 0.65;

}  // namespace

double rim_share(double flatness) {
  return smooth_step((rim_begins - flatness) / (rim_begins - rim_complete));
}

Vector3 least_direction(const Eigen::Matrix3d& tensor) {
  // Not Eigen's iterative solver, which took 2 % of a fit.
  // The adjugate has the products of the other two values, so the smallest one's is largest. Each
  // square doubles the ratio's power.
  constexpr int squares = 5;
  Eigen::Matrix3d power;
  for (int k = 0; k < 3; ++k) {
    power.col(k) = tensor.col((k + 1) % 3).cross(tensor.col((k + 2) % 3));
  }
  // Sheets on one another leave every direction in their plane.
  constexpr double rounding = 1e-13;
  if (!(power.trace() > rounding * tensor.trace() * tensor.trace())) {
    Eigen::Index up = 0;
    tensor.diagonal().maxCoeff(&up);
    return tensor.col(up).unitOrthogonal();
  }
  for (int square = 0; square < squares; ++square) {
    power /= power.trace();
    power = (power * power).eval();
  }
  Eigen::Index longest = 0;
  power.diagonal().maxCoeff(&longest);
  return power.col(longest).normalized();
}

}  // namespace wscvt
