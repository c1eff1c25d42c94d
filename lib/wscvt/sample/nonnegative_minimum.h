// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace wscvt {

/// The minimum of w^T G w - 2 b^T w over w >= 0 (Lawson and Hanson 1974, "Solving Least Squares
/// Problems", ch. 23), G symmetric and positive semi-definite. `start`: which of the variables are
/// likely above 0; may be empty.
Eigen::VectorXd nonnegative_minimum(const Eigen::MatrixXd& g, const Eigen::VectorXd& b,
                                    std::vector<bool> start = {});

}  // namespace wscvt
