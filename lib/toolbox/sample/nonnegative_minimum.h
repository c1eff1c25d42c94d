// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace wscvt {

/// Returns the w >= 0 that minimizes w^T G w - 2 b^T w (Lawson and Hanson 1974, "Solving Least
/// Squares Problems", ch. 23), G symmetric and positive semi-definite. `start`: which variables are
/// likely above 0; may be empty.
Eigen::VectorXd nonnegative_minimum(const Eigen::MatrixXd& g, const Eigen::VectorXd& b,
                                    std::vector<bool> start = {});

}  // namespace wscvt
