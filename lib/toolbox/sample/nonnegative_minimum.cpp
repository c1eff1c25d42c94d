// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/nonnegative_minimum.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace wscvt {

namespace {

/// Returns the minimum over the free variables; the others are 0.
Eigen::VectorXd free_minimum(const Eigen::MatrixXd& g, const Eigen::VectorXd& b,
                             const std::vector<bool>& is_free) {
  std::vector<Eigen::Index> places;
  for (std::size_t k = 0; k < is_free.size(); ++k) {
    if (is_free[k]) places.push_back(k);
  }
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd part(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index row = places[i];
    right[i] = b[row];
    for (Eigen::Index k = 0; k < count; ++k) {
      part(i, k) = g(row, places[k]);
    }
    part(i, i) *= 1.0 + 1e-12;
  }
  const Eigen::VectorXd solved = part.ldlt().solve(right);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(g.rows());
  for (Eigen::Index i = 0; i < count; ++i) all[places[i]] = solved[i];
  return all;
}

/// Moves from a feasible point towards the free minimum; variables that reach 0 first become bound.
Eigen::VectorXd descend(const Eigen::MatrixXd& g, const Eigen::VectorXd& b, Eigen::VectorXd w,
                        std::vector<bool>& is_free) {
  for (Eigen::Index pass = 0; pass <= g.rows(); ++pass) {
    const Eigen::VectorXd wanted = free_minimum(g, b, is_free);
    double step = 1.0;
    for (Eigen::Index k = 0; k < w.size(); ++k) {
      if (is_free[k] && wanted[k] <= 0.0) {
        step = std::min(step, w[k] / std::max(w[k] - wanted[k], 1e-300));
      }
    }
    w += step * (wanted - w);
    if (step >= 1.0) return w.cwiseMax(0.0);
    for (Eigen::Index k = 0; k < w.size(); ++k) {
      if (is_free[k] && wanted[k] <= 0.0 && w[k] <= 1e-14) {
        is_free[k] = false;
        w[k] = 0.0;
      }
    }
  }
  return w.cwiseMax(0.0);
}

}  // namespace

Eigen::VectorXd nonnegative_minimum(const Eigen::MatrixXd& g, const Eigen::VectorXd& b,
                                    std::vector<bool> start) {
  const Eigen::Index count = g.rows();
  std::vector<bool> is_free = std::move(start);
  is_free.resize(static_cast<std::size_t>(count), false);
  Eigen::VectorXd w = Eigen::VectorXd::Zero(count);
  // Free variables of the start that become negative are bound at once.
  for (Eigen::Index pass = 0; pass < count; ++pass) {
    w = free_minimum(g, b, is_free);
    bool all_positive = true;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (is_free[k] && w[k] <= 0.0) {
        is_free[k] = false;
        all_positive = false;
      }
    }
    if (all_positive) break;
  }
  w = w.cwiseMax(0.0);
  const double tolerance = 1e-10 * std::max(b.cwiseAbs().maxCoeff(), 1e-300);
  for (Eigen::Index pass = 0; pass < 3 * count; ++pass) {
    const Eigen::VectorXd slope = b - g * w;
    Eigen::Index steepest = -1;
    double most = tolerance;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (!is_free[k] && slope[k] > most) {
        most = slope[k];
        steepest = k;
      }
    }
    if (steepest < 0) break;
    is_free[steepest] = true;
    w = descend(g, b, w, is_free);
  }
  return w;
}

}  // namespace wscvt
