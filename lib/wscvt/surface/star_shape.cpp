// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/star_shape.h"

#include <Eigen/Dense>

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
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(tensor);
  return solver.eigenvectors().col(0);
}

}  // namespace wscvt
